// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "base/reference_instruments.h"
#include "calib/judgement.h"
#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/magnetometer/ellipse_gyro.h"
#include "calib/magnetometer/ellipsoid_estimator.h"
#include "calib/magnetometer/field_history.h"
#include "calib/magnetometer/field_predictor.h"
#include "calib/magnetometer/field_step_watch.h"
#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Model: measured = offset + S u, S symmetric and positive definite, u the Earth's field in body axes; uT, x
/// forward, y starboard, z down. The rotation that a magnetometer's mounting adds cannot be told from the field
/// alone: it is the misalignment A.
///
/// Runs the three estimators side by side, the ellipse of the levelled field, the same aided by the gyro, the
/// ellipsoid, and names the one whose heading is best of those that accept.
///
/// A field that steps: FieldPredictor says how surprising each reading is. When a cumulative sum of surprise rises
/// (FieldStepWatch) readings wait, and two models are compared on all that is known: one field (the readings tell
/// something new about it), or the same soft iron with another hard iron since the onset. A step is the second,
/// where its likelihood is much the greater, and where the change came at once. A new summary begins then; the old
/// one is kept, and goes on should the old field return. Single readings far off are left out.
///
/// A vehicle at another place has the same iron in a field of another size and dip. That it is elsewhere is known
/// from the field that its fixes tell, or taken from readings that disagree as a run begins. Then it learns anew;
/// until that is accepted, what was accepted at the place before stands, if it makes the field's size here even.
class Magnetometer {
 public:
  struct Parameters {
    EllipseEstimator::Parameters ellipse;
    EllipseGyro::Parameters gyro;
    EllipsoidEstimator::Parameters ellipsoid;
    double tilt_lag_s =
        base::reference::kTiltLag_s;  ///< of the inclinometer: how far off its tilt may be while the hull rolls
  };
  enum class Method : std::uint8_t { none, ellipse, gyro_aided, ellipsoid };

  explicit Magnetometer(const Parameters& parameters);

  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);
  /// Takes a reading and the turn since the reading before, as the gyro measured it.
  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad, const TurnStep& turn);
  /// One reading. Its time is used to date steps of the field. Roll or pitch not a number: the tilt is not
  /// known.
  struct Reading {
    Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
    double roll_rad = 0, pitch_rad = 0;
    bool has_turn = false;
    TurnStep turn;
    double time_s = 0;
    std::int64_t utc_ns = 0;  ///< 0: not known
    void archive(Archive& archive);
  };
  void update(const Reading& reading);
  /// The gyro was calibrated meanwhile.
  void set_gyro(const GyroBelief& gyro);
  /// Standard deviation of the tilt of the readings that come, as far as it is noise, rad.
  void set_tilt_noise(double tilt_noise_rad);
  /// The Earth's field here became known, or is another one: the vehicle has moved.
  void set_known_field(const std::optional<KnownField>& known);
  /// Iterates to the end what update() does in slices.
  void settle();

  [[nodiscard]] Method method() const { return answer().method; }  ///< none: nothing is accepted
  /// Estimate by method(), or the best guess when nothing is accepted; nullopt when there is none.
  [[nodiscard]] const std::optional<MagnetometerEstimate>& estimate() const { return answer().estimate; }
  /// Judgement of the same method as estimate().
  [[nodiscard]] const Judgement& judgement() const { return answer().judgement; }

  [[nodiscard]] const EllipseEstimator& ellipse() const { return now_.ellipse; }
  [[nodiscard]] const EllipseGyro& gyro_aided() const { return now_.gyro; }
  [[nodiscard]] const EllipsoidEstimator& ellipsoid() const { return now_.ellipsoid; }

  /// Steps told so far, without those that were withdrawn; and the number of these.
  [[nodiscard]] std::uint32_t field_steps() const { return field_steps_; }
  [[nodiscard]] std::uint32_t withdrawn_steps() const { return withdrawn_steps_; }
  /// Changes of place so far, and whether the vehicle is at another place than what it learnt before.
  [[nodiscard]] std::uint32_t moves() const { return moves_; }
  [[nodiscard]] bool is_elsewhere() const { return is_elsewhere_; }
  [[nodiscard]] std::optional<FieldStep> last_step() const;
  /// Relative scatter of the size of the readings of the present field, corrected so; 0 without readings.
  [[nodiscard]] double scatter_of_size(const FieldCorrection& correction) const;
  /// Steps, and the segments between them.
  [[nodiscard]] const FieldHistory& history() const { return history_; }
  [[nodiscard]] std::uint64_t readings() const { return readings_; }
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< not finite, absurd, or off the fit

  void archive(Archive& archive);

 private:
  /// The estimators of one field.
  struct Estimators {
    EllipseEstimator ellipse;
    EllipseGyro gyro;
    EllipsoidEstimator ellipsoid;
    FieldPredictor predictor;
    std::optional<KnownField> known;  ///< field of the Earth in which they learn

    explicit Estimators(const Parameters& parameters);
    void update(const Reading& reading, const PredictedReading& predicted);
    void set_known(const std::optional<KnownField>& field);
    void settle();
    void archive(Archive& archive);
  };

  struct Answer {
    Method method = Method::none;
    std::optional<MagnetometerEstimate> estimate;
    Judgement judgement;
  };

  [[nodiscard]] const Answer& answer() const;
  [[nodiscard]] static Answer chosen(const Estimators& of);
  /// The readings here have an even size by what was learnt at the place before.
  [[nodiscard]] bool has_same_iron() const;
  /// A reading that waits until it is known which field it is of.
  struct Waiting {
    Reading reading;
    PredictedReading predicted;
    std::uint64_t number = 0;
    void archive(Archive& archive);
  };

  [[nodiscard]] PredictedReading predicted_of(const Reading& reading) const;
  void leave_out();
  void use(const Waiting& waiting);
  /// `is_sure`: the last step is none to be withdrawn.
  void refine_history(bool is_sure = false);
  /// All that wait are of the field so far, but for those far off.
  void release();
  /// Compares one field with a step, and does what follows.
  void decide();
  void change_field(const FieldStep& step);
  [[nodiscard]] bool is_at_another_place() const;
  void begin_place();
  void use_waiting();
  struct Comparison;
  [[nodiscard]] Comparison compare() const;
  /// The first of those that wait that is of the new field, by the greatest likelihood.
  [[nodiscard]] std::size_t onset_of(const Comparison& found) const;
  void use_those_before(std::size_t onset);
  /// Readings of neither field, taken while it changed.
  void leave_out_those_between(const Comparison& found);
  /// Difference of the field between the readings before and after the onset. Its uncertainty includes the
  /// hull's turn meanwhile, as the gyro measured it.
  /// `onset`: number of the first reading of the new field; `first_waiting`: of those that wait, the first used.
  [[nodiscard]] std::optional<FieldContrast> contrast(std::uint64_t onset, std::size_t first_waiting) const;
  /// A step of that size from the first reading that waits on.
  [[nodiscard]] FieldStep step_at_first_waiting(const Eigen::Vector3d& size_uT,
                                                const Eigen::Vector3d& std_uT) const;
  template <class Condition>
  void leave_out_waiting(const Condition& is_left_out);
  /// Tells a step whose size no turn of the hull explains, whatever the shape of the field may be. True: it is
  /// done.
  bool tell_at_rest();
  [[nodiscard]] bool is_field_before() const;

  Parameters parameters_;
  Estimators now_;
  std::optional<Estimators> before_;  ///< those of the field before the last step, or of the place before
  bool is_elsewhere_ = false;         ///< `before_` is of another place
  std::uint32_t moves_ = 0;
  bool is_arriving_ = false;  ///< a run has begun, and its first readings wait
  FieldStepWatch watch_;
  FieldHistory history_;
  std::vector<Waiting> waiting_;             ///< since the sum of surprise last was zero
  std::uint64_t next_decision_ = 0;          ///< readings that must wait before it is looked again
  std::deque<FieldCells<3, 6>::Cell> past_;  ///< the last that were used
  std::optional<Eigen::Vector3d> last_down_;
  double last_time_s_ = 0;
  std::uint32_t field_steps_ = 0, withdrawn_steps_ = 0;
  std::uint64_t readings_ = 0;
  std::uint64_t left_out_ = 0;
  mutable std::optional<Answer> answer_;  ///< to judge takes longer than to learn; empty: not asked since
  bool turn_broken_ = false;              ///< a reading was left out since the last that was used
};

}  // namespace navcal::calib
