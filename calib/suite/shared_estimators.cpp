// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/shared_estimators.h"

namespace navcal::calib {

TurnFilter::Parameters turn_parameters(const SuiteOptions& options) {
  return {.heading_noise_rad = options.heading_noise_rad,
          .rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s,
          .bias_walk_rad_s_sqrt_s = options.bias_walk_rad_s_sqrt_s};
}

Magnetometer::Parameters field_parameters(const SuiteOptions& options) {
  Magnetometer::Parameters parameters;
  parameters.ellipse.noise_uT = options.field_noise_uT;
  parameters.gyro.noise_uT = options.field_noise_uT;
  parameters.gyro.rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s;
  parameters.ellipsoid.noise_uT = options.field_noise_uT;
  parameters.ellipsoid.known = options.local_field.known;
  parameters.ellipsoid.tilt_noise_rad = options.tilt_noise_rad;
  if (options.tilt_lag_s > 0) parameters.tilt_lag_s = options.tilt_lag_s;  // else accelerometers show the tilt
  return parameters;
}

DelayEstimator::Parameters delay_parameters(const SuiteOptions& options) {
  DelayEstimator::Parameters parameters;
  parameters.heading.heading_noise_rad = options.heading_noise_rad;
  parameters.heading.rate_noise_rad_sqrt_s = options.rate_noise_rad_sqrt_s;
  parameters.field.field_noise_uT = options.field_noise_uT;
  parameters.course.velocity_std_m_s = options.velocity_noise_m_s;
  parameters.tilt_lag_s = options.tilt_lag_s;
  parameters.tilt_noise_rad = options.tilt_noise_rad;
  return parameters;
}

SharedEstimators::SharedEstimators(const SuiteOptions& options)
    : gyro(TurnCalibrator::Subject::gyro, turn_parameters(options)), magnetometer(field_parameters(options)),
      gps(options), delays(delay_parameters(options)), gyros({}),
      motor_current({options.field_noise_uT, options.rate_noise_rad_sqrt_s}) {}

}  // namespace navcal::calib
