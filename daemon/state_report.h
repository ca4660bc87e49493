// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::daemon {

/// Content of STATE (docs/status-protocol.md), all at one instant. Absent values are null.
struct VehicleState {
  std::optional<std::int64_t> time_utc_ns;
  std::optional<double> time_std_s;
  bool is_north_true = false;
  std::optional<double> heading_rad, pitch_rad, roll_rad;
  std::optional<std::array<double, 3>> rate_rad_s;
  std::optional<double> depth_m;
  std::optional<double> latitude_rad, longitude_rad, position_std_m;
  std::optional<double> speed_m_s, climb_m_s;
  std::optional<double> shaft_rpm;
  std::array<std::optional<double>, 3> fins_deg;
  std::optional<double> heading_std_rad, pitch_std_rad, depth_std_m, speed_std_m_s;
  std::optional<double> compass_age_s, imu_age_s, gps_age_s, motor_age_s;
  std::vector<std::string_view> alarms;  ///< names with underscores
  std::string holder;                    ///< of the motor's lease; empty: none
  int priority = 0;
  double expires_in_s = 0;
  std::uint64_t order_sequence = 0;  ///< 0: no order yet
  std::optional<double> order_late_s;
  std::optional<double> altitude_m, altitude_std_m;  ///< above the sea floor
  std::optional<double> battery_V, charge_Ah, charge_std_Ah;
};

/// Appends one line, newline included.
void append_state(std::string& out, const VehicleState& state);

}  // namespace navcal::daemon
