// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Devices that a file describes (docs/devices.md).
namespace navcal::protocols::described {

/// The quantity that a number of a described device is. Body axes are x forward, y to starboard, z down.
enum class Meaning : std::uint8_t {
  none,    ///< the number is checked and shown, and no sample has it
  sensor,  ///< a mission sensor, which the description names
  rate_x,
  rate_y,
  rate_z,
  rate_yaw_b,
  specific_force_x,
  specific_force_y,
  specific_force_z,
  heading,
  heading_true,
  pitch,
  roll,
  field_x,
  field_y,
  field_z,
  dip,
  turn_rate,
  depth,
  pressure,
  temperature,
  altitude,
  bottom_velocity_x,
  bottom_velocity_y,
  bottom_velocity_z,
  bottom_velocity_north,
  bottom_velocity_east,
  bottom_velocity_down,
  water_velocity_x,
  water_velocity_y,
  water_velocity_z,
  water_velocity_north,
  water_velocity_east,
  water_velocity_down,
  sound_speed,
  latitude,
  longitude,
  height,
  height_msl,
  speed,
  course,
  climb,
  dop,
  satellites,
  utc,
  rpm,
  rpm_commanded,
  fin_1,
  fin_2,
  fin_3,
  motor_current,
  voltage,
  current,
  sequence,
  leak_forward,
  leak_aft,
  over_range,
  low_supply,
};
inline constexpr std::size_t kMeaningCount = static_cast<std::size_t>(Meaning::low_supply) + 1;

/// Units that stand for the same physical quantity fit each other.
enum class Dimension : std::uint8_t {
  any,
  number,
  angle,
  angular_rate,
  acceleration,
  magnetic_field,
  length,
  velocity,
  pressure,
  temperature,
  voltage,
  current,
  rotation,
  time,
};

struct MeaningInfo {
  std::string_view name{};  ///< "rate.x"
  Dimension dimension = Dimension::number;
  /// Values beyond these cannot be; in the unit of samples (rad, m, s, uT, C, Pa, V, A, revolutions a minute).
  double low = 0, high = 0;
};

[[nodiscard]] const MeaningInfo& info_of(Meaning meaning);
[[nodiscard]] std::optional<Meaning> meaning_named(std::string_view name);

/// A unit of a description: a number in it times `factor`, plus `offset`, is the number in the unit of samples.
struct Unit {
  std::string_view name{};
  Dimension dimension = Dimension::number;
  double factor = 1;
  double offset = 0;
};

[[nodiscard]] std::span<const Unit> all_units();
/// nullptr: there is no such unit.
[[nodiscard]] const Unit* unit_named(std::string_view name);

}  // namespace navcal::protocols::described
