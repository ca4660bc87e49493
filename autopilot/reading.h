// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace navcal::autopilot {

/// The vehicle's state as the daemon reports it (class STATE of docs/status-protocol.md). SI units and radians;
/// what is not known is absent.
struct Reading {
  std::optional<double> heading_rad;  ///< wrapped
  std::optional<double> pitch_rad;
  std::optional<double> roll_rad;
  std::optional<Eigen::Vector3d> rate_rad_s;  ///< body rates p, q, r
  std::optional<double> depth_m;
  std::optional<double> altitude_m;  ///< above the sea floor
  std::optional<double> latitude_rad, longitude_rad;
  std::optional<double> speed_m_s;
  // Age of the newest reading of each instrument; absent: there was none.
  std::optional<double> compass_age_s, imu_age_s, motor_age_s;
  std::vector<std::string>
      alarms;  ///< "leak forward", "leak aft", "over range", "low supply", "battery low", "floor near"
};

}  // namespace navcal::autopilot
