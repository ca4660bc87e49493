// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calib/delay/delay_estimator.h"
#include "calib/magnetometer/magnetometer.h"
#include "calib/magnetometer/motor_current.h"
#include "calib/suite/gps_calibrators.h"
#include "calib/suite/suite_options.h"
#include "calib/turn/gyro_pair.h"
#include "calib/turn/turn_calibrator.h"

namespace navcal::calib {

[[nodiscard]] TurnFilter::Parameters turn_parameters(const SuiteOptions& options);
[[nodiscard]] Magnetometer::Parameters field_parameters(const SuiteOptions& options);
[[nodiscard]] DelayEstimator::Parameters delay_parameters(const SuiteOptions& options);

/// Estimators that serve more than the calibrator that feeds and archives them.
struct SharedEstimators {
  explicit SharedEstimators(const SuiteOptions& options);

  TurnCalibrator gyro;         ///< fed by gyro; a reference for compass, magnetometer and swing
  Magnetometer magnetometer;   ///< fed by magnetometer; its history of the field is reported
  GpsCalibrators gps;          ///< fed by gps_compass; also estimates the misalignment
  DelayEstimator delays;       ///< fed by compass_delay; also estimates the delay of the course
  GyroPair gyros;              ///< fed by gyro_b: both gyros as calibrated
  MotorCurrent motor_current;  ///< fed by motor_current; its current serves all that use the field
};

}  // namespace navcal::calib
