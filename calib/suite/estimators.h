// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "calib/archive.h"
#include "calib/correction.h"
#include "calib/suite/calibrator_unit.h"
#include "calib/suite/reading_queue.h"
#include "calib/suite/shared_estimators.h"
#include "calib/suite/suite_options.h"
#include "calib/turn/turn_integrator.h"

namespace navcal::calib {

/// The units of all calibrators, fed with readings in the order of their times. Prepares what they take: turns
/// between readings of the compass, the field without the motor's, and the order in time across instruments.
class Estimators {
 public:
  explicit Estimators(const SuiteOptions& options);

  /// Takes the reading as measured. Calibrators other than that of the motor current get the field without the
  /// motor's, where that correction is active.
  void update(const CompassReading& reading, const Correction& in_force);
  void update(const RateReading& reading);
  void update(const GroundReading& reading, const Correction& in_force);
  void update(const MotorReading& reading, const Correction& in_force);
  void update(const ReferenceReading& reading);
  /// The next reading of the compass whose turn is known, or that will have none; it has been through all
  /// estimators. To be called until there is none.
  std::optional<TurnedReading> next(const Correction& in_force);
  /// Called when no more readings come.
  void finish();
  void settle();

  /// Takes effect from the next reading.
  void set_local_field(const LocalField& field);
  /// Restarts the calibrators that build on `calibrator`, whose active correction changed.
  void on_in_force(Calibrator calibrator, const Correction& in_force);

  /// The newest estimate of each calibrator that has one.
  [[nodiscard]] Correction estimates() const;
  [[nodiscard]] CalibratorUnit& unit(Calibrator calibrator) { return *units_[index_of(calibrator)]; }
  [[nodiscard]] const CalibratorUnit& unit(Calibrator calibrator) const { return *units_[index_of(calibrator)]; }
  [[nodiscard]] const Magnetometer& magnetometer() const { return shared_->magnetometer; }
  /// Archives all but the units from the eleventh on: Suite archives those by name.
  void archive(Archive& archive);

 private:
  static constexpr std::size_t kPending = 64, kBeside = 512;

  /// Active calibration of gyro A, or an estimate good enough for the other calibrators.
  [[nodiscard]] std::optional<RateCorrection> known_gyro(const Correction& in_force) const;
  TurnedReading take_pending(std::optional<TurnStep> turn);
  /// A fix or a shaft reading waits for the compass readings before it, which themselves wait for their turns.
  void wait(const Reading& reading, const Correction& in_force);
  /// Passes the waiting readings up to `time_s` to the calibrators.
  void release(double time_s, const Correction& in_force);
  void learn(const TurnedReading& turned, const Correction& in_force);

  SuiteOptions options_;
  TurnIntegrator turns_;
  std::unique_ptr<SharedEstimators> shared_;            ///< the units refer to it
  std::vector<std::unique_ptr<CalibratorUnit>> units_;  ///< in the order of the table
  std::array<CompassReading, kPending> pending_{};      ///< ring: their turns are not known yet
  std::size_t first_pending_ = 0, pending_count_ = 0;
  std::deque<QueuedReading> beside_;  ///< fixes and readings of the shaft, in the order of their times
  std::optional<TurnStep> turn_;      ///< of a pending reading, or of a later one
  bool heading_seen_ = false;         ///< the compass sends headings of its own
  bool finishing_ = false;
};

}  // namespace navcal::calib
