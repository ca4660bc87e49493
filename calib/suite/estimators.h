// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calib/archive.h"
#include "calib/correction.h"
#include "calib/delay/delay_estimator.h"
#include "calib/judgement.h"
#include "calib/magnetometer/magnetometer.h"
#include "calib/magnetometer/motor_current.h"
#include "calib/suite/gps_calibrators.h"
#include "calib/suite/report.h"
#include "calib/suite/suite_options.h"
#include "calib/swing/swing.h"
#include "calib/turn/gyro_pair.h"
#include "calib/turn/turn_calibrator.h"
#include "calib/turn/turn_integrator.h"

namespace navcal::calib {

/// A reading of the compass with the turn that led to it, where the gyro tells it.
struct TurnedReading {
  CompassReading reading;
  std::optional<TurnStep> turn;
};

/// All estimators, fed with readings in the order of their times.
class Estimators {
 public:
  explicit Estimators(const SuiteOptions& options);

  /// The reading as measured. The others are fed with the field without the motor's, where that is in force.
  void update(const CompassReading& reading, const Correction& in_force);
  void update(const RateReading& reading);
  void update(const GroundReading& reading, const Correction& in_force);
  void update(const MotorReading& reading, const Correction& in_force);
  /// The next reading of the compass whose turn is known, or that will have none; it has been through all
  /// estimators. To be called until there is none.
  std::optional<TurnedReading> next(const Correction& in_force);
  /// No more readings come.
  void finish();
  void settle() { magnetometer_.settle(); }

  /// From here on.
  void set_local_field(const LocalField& field);
  /// One calibrator forgets what it has seen; the compass keeps what is known of the gyro.
  void start(Calibrator calibrator);
  /// What is in force changed for one calibrator: those that build on it begin anew.
  void on_in_force(Calibrator calibrator, const Correction& in_force);

  /// The newest estimate of each calibrator that has one.
  [[nodiscard]] Correction estimates() const;
  /// Of one calibrator, put into its place in `into`, or that place emptied.
  void put_estimate(Calibrator calibrator, Correction& into) const;
  [[nodiscard]] Judgement judgement(Calibrator calibrator) const;
  [[nodiscard]] std::vector<Quantity> quantities(Calibrator calibrator) const;
  /// As in CalibratorReport.
  [[nodiscard]] Eigen::MatrixXd covariance(Calibrator calibrator) const;
  [[nodiscard]] const Magnetometer& magnetometer() const { return magnetometer_; }
  [[nodiscard]] const Comparison& misalignment_comparison() const { return surface_.comparison(); }
  /// Of the field's misfit about changes of the motor's current, uT.
  [[nodiscard]] const Comparison& motor_comparison() const { return motor_current_.comparison(); }
  void archive(Archive& archive);

 private:
  static constexpr std::size_t kPending = 64, kBeside = 512;

  [[nodiscard]] TurnPrior compass_prior() const;
  [[nodiscard]] const TurnCalibrator& turn_calibrator(Calibrator calibrator) const;
  /// Of what is in force, or estimated well enough to serve the other calibrators.
  [[nodiscard]] std::optional<RateCorrection> known_gyro(const Correction& in_force) const;
  TurnedReading take_pending(std::optional<TurnStep> turn);
  /// A fix or a reading of the shaft waits for the readings of the compass before it, which wait for their turns.
  void wait(const Reading& reading, const Correction& in_force);
  /// Those up to `time_s` are learnt from.
  void release(double time_s, const Correction& in_force);
  void learn(const TurnedReading& turned, const Correction& in_force);
  void tell_magnetometer_of_gyro();
  void learn_field(const TurnedReading& turned);
  void learn_swing(const TurnStep& turn, const Correction& in_force);

  SuiteOptions options_;
  TurnIntegrator turns_;
  TurnCalibrator gyro_, gyro_b_, compass_;
  Magnetometer magnetometer_;
  GpsCalibrators surface_;
  DelayEstimator delays_;
  GyroPair gyros_;
  MotorCurrent motor_current_;
  std::optional<Swing> swing_;  ///< begun by the operator
  double swing_reference_rad_ = 0, swing_heading_rad_ = 0;
  bool swing_anchored_ = false;
  std::array<CompassReading, kPending> pending_{};  ///< ring: their turns are not known yet
  std::size_t first_pending_ = 0, pending_count_ = 0;
  std::deque<QueuedReading> beside_;  ///< fixes and readings of the shaft, in the order of their times
  std::optional<TurnStep> turn_;      ///< of a pending reading, or of a later one
  bool heading_seen_ = false;         ///< the compass says headings of its own
  bool finishing_ = false;
};

}  // namespace navcal::calib
