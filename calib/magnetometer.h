#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "calib/ellipse_estimator.h"
#include "calib/ellipse_gyro.h"
#include "calib/ellipsoid_estimator.h"
#include "calib/field_step_watch.h"
#include "calib/judgement.h"
#include "calib/magnetometer_estimate.h"
#include "calib/turn_step.h"

namespace navcal::calib {

/// Model: measured = offset + S u, S symmetric and positive definite, u the Earth's field in body axes; uT, x
/// forward, y starboard, z down. The rotation that a magnetometer's mounting adds cannot be told from the field
/// alone: it is the misalignment A.
///
/// Runs the three estimators side by side, the ellipse of the levelled field, the same aided by the gyro, the
/// ellipsoid, and names the one whose heading is best of those that accept. Readings far off the fit are left out;
/// when they stay off, the field has stepped: a new summary begins with the readings since, the old estimate
/// is kept as it was, and should the old field return its summary goes on.
class Magnetometer {
 public:
  struct Parameters {
    EllipseEstimator::Parameters ellipse;
    EllipseGyro::Parameters gyro;
    EllipsoidEstimator::Parameters ellipsoid;
  };
  enum class Method : std::uint8_t { none, ellipse, gyro_aided, ellipsoid };

  explicit Magnetometer(const Parameters& parameters);

  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);
  /// With the turn since the reading before, by the gyro.
  void update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad, const TurnStep& turn);
  /// The gyro was calibrated meanwhile.
  void set_gyro(const GyroBelief& gyro);
  /// Iterates to the end what update() does in slices.
  void settle();

  [[nodiscard]] Method method() const { return answer().method; }  ///< none: nothing is accepted
  /// Of method(); of the best guess when nothing is accepted; nullopt when there is none.
  [[nodiscard]] const std::optional<MagnetometerEstimate>& estimate() const { return answer().estimate; }
  /// Of the same.
  [[nodiscard]] const Judgement& judgement() const { return answer().judgement; }

  [[nodiscard]] const EllipseEstimator& ellipse() const { return now_.ellipse; }
  [[nodiscard]] const EllipseGyro& gyro_aided() const { return now_.gyro; }
  [[nodiscard]] const EllipsoidEstimator& ellipsoid() const { return now_.ellipsoid; }

  [[nodiscard]] std::uint32_t field_steps() const { return field_steps_; }
  [[nodiscard]] const std::optional<FieldStep>& last_step() const { return last_step_; }
  [[nodiscard]] std::uint64_t readings() const { return readings_; }
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< not finite, absurd, or off the fit

  void archive(Archive& archive);

 private:
  struct Reading {
    Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
    double roll_rad = 0, pitch_rad = 0;
    bool has_turn = false;
    TurnStep turn;
    void archive(Archive& archive);
  };
  /// The estimators of one field.
  struct Estimators {
    EllipseEstimator ellipse;
    EllipseGyro gyro;
    EllipsoidEstimator ellipsoid;

    explicit Estimators(const Parameters& parameters);
    void update(const Reading& reading);
    /// Squared distance of a reading from the fits in units of its variance, the worst of both; 0 without a fit.
    [[nodiscard]] double surprise(const Reading& reading) const;
    void archive(Archive& archive);
  };

  struct Answer {
    Method method = Method::none;
    std::optional<MagnetometerEstimate> estimate;
    Judgement judgement;
  };

  [[nodiscard]] const Answer& answer() const;
  [[nodiscard]] Answer chosen() const;
  void take(const Reading& reading);
  void leave_out();
  void change_field();

  Parameters parameters_;
  Estimators now_;
  std::optional<Estimators> before_;  ///< those of the field before the last step
  FieldStepWatch watch_;
  std::array<Reading, FieldStepWatch::kLongest> recent_{};  ///< ring, by the number of the reading
  std::uint32_t field_steps_ = 0;
  std::optional<FieldStep> last_step_;
  std::uint64_t readings_ = 0;
  std::uint64_t left_out_ = 0;
  mutable std::optional<Answer> answer_;  ///< to judge takes longer than to learn; empty: not asked since
  bool turn_broken_ = false;              ///< a reading was left out since the last that was used
};

}  // namespace navcal::calib
