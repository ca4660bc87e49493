// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "calib/correction.h"
#include "calib/suite/in_force.h"

namespace navcal::pipeline {

/// Commands of an operator.
enum class CalibrationOrder : std::uint8_t {
  accept,     ///< the newest estimate comes into force
  force,      ///< the same, also when the estimate is refused
  roll_back,  ///< what was in force before comes back, and stays until accepted or started anew
  start,      ///< the calibrator forgets what it has seen; what is in force stays
};

/// A change of the calibrations. It is recorded; those that came from outside are made again in replay.
struct CalibrationChange {
  enum class Cause : std::uint8_t {
    begin,      ///< a log begins: state of everything, for replay to go on from
    automatic,  ///< better by the margin on readings held out: follows from the readings, in replay too
    accept,
    force,  ///< accepted by the operator although it was refused
    roll_back,
    start,
  };
  std::int64_t time_ns = 0;  ///< monotonic
  Cause cause = Cause::begin;
  std::optional<calib::Calibrator> calibrator;  ///< none: all
  calib::CorrectionName name;                   ///< in force from now on
  calib::Correction in_force;
  std::string state;  ///< with `begin`: CalibrationStage's, to be restored
};

/// "begin", "automatic", "accept", "force", "rollback", "start".
[[nodiscard]] std::string_view name_of(CalibrationChange::Cause cause);

}  // namespace navcal::pipeline
