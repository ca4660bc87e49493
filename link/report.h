// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "link/frame.h"

namespace navcal::link {

/// Alarms of a report, by bit: bit 0 is the first. New ones are added at the end.
inline constexpr std::array<std::string_view, 10> kAlarmNames{
    "leak_forward", "leak_aft",    "over_range", "low_supply",  "command_not_echoed",
    "link_dead",    "battery_low", "floor_near", "log_failing", "orders_refused"};
/// Set for an alarm that this list does not know.
inline constexpr unsigned kOtherAlarmBit = 15;

/// Verdicts on a calibrator's estimate, by number.
inline constexpr std::array<std::string_view, 3> kVerdictNames{"refused", "shadow", "in_force"};

/// State of one calibrator; the reports tell of one after the other.
struct CalibrationState {
  std::string calibrator;    ///< "gyro", its first sixteen bytes
  std::uint8_t verdict = 0;  ///< of kVerdictNames
  std::uint16_t number = 0;  ///< of the calibration in force, low bits; with the hash its name: "7-1a2b3c4d"
  std::uint32_t hash = 0;

  bool operator==(const CalibrationState&) const = default;
};

/// The vehicle's state in short (docs/remote.md has the bytes). Absent values are not known.
struct Report {
  std::optional<std::int64_t> time_utc_ms;
  bool is_north_true = false;
  std::optional<double> heading_deg, pitch_deg, roll_deg;
  std::array<std::optional<double>, 3> rate_deg_s;  ///< about x, y, z
  std::optional<double> depth_m;                    ///< downwards
  std::optional<double> latitude_deg, longitude_deg;
  std::optional<double> position_std_m, heading_std_deg, depth_std_m;
  std::optional<double> speed_m_s, climb_m_s;  ///< through the water ahead; upwards
  std::optional<double> shaft_rpm;
  std::array<std::optional<double>, 3> fins_deg;
  std::optional<double> compass_age_s, imu_age_s, gps_age_s, motor_age_s;
  std::uint16_t alarms = 0;  ///< bits of kAlarmNames
  std::uint16_t order_sequence = 0;
  std::optional<double> battery_V, battery_charge;  ///< charge: 0 to 1
  std::uint16_t priority = 0;
  std::optional<double> expires_in_s;
  std::string holder;  ///< of the motor's lease, its first twelve bytes; empty: nobody
  std::optional<CalibrationState> calibration;

  [[nodiscard]] std::vector<std::string_view> alarm_names() const;
  void set_alarm(std::string_view name);
};

inline constexpr std::size_t kMaxReport = 102;

[[nodiscard]] Buffer encode_report(const Report& report);
/// nullopt when the payload is too short or of another version.
[[nodiscard]] std::optional<Report> decode_report(Bytes payload);

}  // namespace navcal::link
