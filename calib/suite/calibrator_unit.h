// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "calib/archive.h"
#include "calib/calibrator.h"
#include "calib/correction.h"
#include "calib/gps/gps_track.h"
#include "calib/judgement.h"
#include "calib/turn/held_out.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// A reading of the compass with the turn that led to it, where the gyro tells it.
struct TurnedReading {
  CompassReading reading;
  std::optional<TurnStep> turn;
};

/// A reading of the compass with all that is known about it.
struct LearntReading {
  const CompassReading& reading;
  const std::optional<TurnStep>& turn;
  const WaterTrackReading& track;
  /// Active calibration of gyro A, or an estimate good enough for the other calibrators.
  const std::optional<RateCorrection>& gyro;
  const Correction& in_force;
};

/// Held-out readings of a calibrator that compares them itself.
struct OwnComparison {
  const Comparison* comparison = nullptr;  ///< null: HeldOut judges the calibrator
  HeldOutQuantity quantity = HeldOutQuantity::heading;
};

/// One calibrator: learns from readings, estimates its correction, and judges the estimate. A unit overrides the
/// inputs that it needs. It is made by its row in the table, and called in the order of the table. No input may
/// allocate memory: they are called for every sample.
class CalibratorUnit {
 public:
  CalibratorUnit() = default;
  CalibratorUnit(const CalibratorUnit&) = delete;
  CalibratorUnit& operator=(const CalibratorUnit&) = delete;
  virtual ~CalibratorUnit() = default;

  /// The unit's place in the table; set once, when it is made.
  void set_calibrator(Calibrator calibrator) { calibrator_ = calibrator; }

  // Inputs as the instruments deliver them, each in the order of its times.
  /// The reading as measured, with the motor's field.
  virtual void update_measured(const CompassReading& /*reading*/, const Correction& /*in_force*/) {}
  /// Takes the reading without the motor's field, where that correction is active.
  virtual void update_compass(const CompassReading& /*reading*/) {}
  virtual void update_rate(const RateReading& /*reading*/) {}
  virtual void update_motor(const MotorReading& /*reading*/) {}
  /// True headings of the external reference; they come before the headings of their time in update_learnt().
  virtual void update_reference(const ReferenceReading& /*reading*/) {}
  /// No more readings come from the instruments; the inputs below may still follow.
  virtual void finish() {}

  // Inputs of several instruments, all in the order of their times.
  virtual void update_turn(const TurnStep& /*step*/) {}
  virtual void update_learnt(const LearntReading& /*reading*/) {}
  virtual void update_ground(const GroundReading& /*reading*/, const Correction& /*in_force*/) {}
  virtual void update_shaft(const MotorReading& /*reading*/) {}
  /// All readings were given: iterate to the end.
  virtual void settle() {}

  /// Forgets what was learnt.
  virtual void start() = 0;
  /// Called when the active value of a calibrator, possibly this one, has changed.
  virtual void on_in_force(Calibrator /*changed*/, const Correction& /*in_force*/) {}
  /// The Earth's field here became known: the options' local field.
  virtual void on_local_field(const SuiteOptions& /*options*/) {}

  /// Puts the newest estimate into its place in `into`, or empties that place.
  virtual void put_estimate(Correction& into) const = 0;
  [[nodiscard]] virtual Judgement judgement() const = 0;
  /// Empty when there is no estimate.
  [[nodiscard]] virtual std::vector<Quantity> quantities() const = 0;
  /// Covariance of correlated coefficients; empty for most calibrators.
  [[nodiscard]] virtual Eigen::MatrixXd covariance() const { return {}; }
  [[nodiscard]] virtual OwnComparison comparison() const { return {}; }
  /// The whole state, exactly.
  virtual void archive(Archive& archive) = 0;

 protected:
  /// Puts the numbers of a calibrator without a member in Correction; used by put_estimate(). No numbers: there
  /// is no estimate.
  void put_added(Correction& into, std::span<const double> numbers) const { into.added.set(calibrator_, numbers); }

 private:
  Calibrator calibrator_ = Calibrator::gyro;
};

// Helpers of quantities().
inline constexpr double kUnknownStd = std::numeric_limits<double>::infinity();
/// Infinite for a negative variance or one that is not a number.
[[nodiscard]] inline double std_of(double variance) { return variance >= 0 ? std::sqrt(variance) : kUnknownStd; }
/// A number that the readings determine to better than `unknown`; else not a number.
[[nodiscard]] inline Quantity determined(std::string_view name, double value, double std, double unknown) {
  if (!(std < unknown)) return {name, std::numeric_limits<double>::quiet_NaN(), kUnknownStd};
  return {name, value, std};
}

/// Place of a member of Correction: place_of<&Correction::gyro>().
template <auto member>
[[nodiscard]] constexpr CorrectionPlace place_of() {
  return {[](const Correction& correction, Calibrator) { return (correction.*member).has_value(); },
          [](Correction& to, const Correction& from, Calibrator) { to.*member = from.*member; }};
}

/// Makes a unit of the given class; used in the rows of the table.
template <class Unit>
std::unique_ptr<CalibratorUnit> make_unit(const SuiteOptions& options, SharedEstimators& shared) {
  return std::make_unique<Unit>(options, shared);
}

}  // namespace navcal::calib
