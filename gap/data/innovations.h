// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "devices/instrument_model.h"

namespace navcal::gap {

/// Innovation channels of a replay, ten rows a second: measured minus predicted, each the mean over a tenth of
/// a second.
enum Channel : Eigen::Index {
  field_x,  // uT
  field_y,
  field_z,
  tilt_roll,  // rad
  tilt_pitch,
  gyro_pitch,  // rad/s: B-y, then the yaw gyros A-z and B-z
  gyro_yaw_a,
  gyro_yaw_b,
  force_x,  // m/s2
  force_y,
  force_z,
  depth,  // m
  // Channels for the residual map only: they follow from the others or harm the evidence.
  heading,    // rad
  gyro_roll,  // rad/s
};
inline constexpr Eigen::Index kEvidenceChannels = 12;
inline constexpr Eigen::Index kChannels = 14;

/// Innovations at a fix: position divided by the standard deviation of its prediction, and velocity in m/s of a
/// settled receiver.
enum FixChannel : Eigen::Index { fix_north, fix_east, velocity_north, velocity_east };
inline constexpr Eigen::Index kFixChannels = 4;

inline constexpr double kInterval_s = 0.1;

/// Error of the estimator at the first good fix after a time without fixes.
struct Resurfacing {
  double time_s = 0;
  double distance_m = 0;  ///< through the water since the last fix
  double error_m = 0;
};

/// Rows are intervals or fixes; what was not measured is NaN.
struct Innovations {
  Eigen::MatrixXd grid;         ///< intervals x kChannels
  Eigen::MatrixXd fixes;        ///< fixes x kFixChannels
  Eigen::VectorXd fix_scale_m;  ///< divisor of each fix's position innovations
  std::vector<Resurfacing> resurfacings;
};

/// Estimated state at the middle of each interval: covariates of the residuals.
struct Trajectory10Hz {
  devices::InstrumentModel instruments;  ///< of the mission
  std::vector<double> time_s, heading_rad, roll_rad, pitch_rad, yaw_rate_rad_s, pitch_rate_rad_s, depth_m,
      surge_m_s, current_A, temperature_rise_C, rudder_rad, elevator_rad, shaft_rps;
};

}  // namespace navcal::gap
