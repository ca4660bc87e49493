// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace navcal::identify {

/// What instruments measure. Body axes x forward, y starboard, z down; SI units and radians.
enum class Channel : std::size_t {
  rate_x,
  rate_y,
  rate_z,
  second_yaw_rate,
  force_x,
  force_y,
  force_z,
  roll,
  pitch,
  heading,      ///< as the device sends it
  depth,        ///< of the inertial unit
  gauge_depth,  ///< of a pressure gauge
  bottom_x,     ///< velocity over the bottom
  bottom_y,
  bottom_z,
  water_x,  ///< velocity through the water
  water_y,
  water_z,
  north,  ///< of the recording's first fix
  east,
  north_velocity,
  east_velocity,
};
inline constexpr std::size_t kChannels = 22;

struct ChannelDescription {
  std::string_view name, unit;
  bool is_angle = false;
};
inline constexpr std::array<ChannelDescription, kChannels> kChannelDescriptions{
    {{"roll rate", "rad/s"},
     {"pitch rate", "rad/s"},
     {"yaw rate", "rad/s"},
     {"yaw rate of the second gyro", "rad/s"},
     {"specific force x", "m/s2"},
     {"specific force y", "m/s2"},
     {"specific force z", "m/s2"},
     {"roll", "rad", true},
     {"pitch", "rad", true},
     {"heading", "rad", true},
     {"depth", "m"},
     {"depth of the gauge", "m"},
     {"velocity over the bottom x", "m/s"},
     {"velocity over the bottom y", "m/s"},
     {"velocity over the bottom z", "m/s"},
     {"velocity through the water x", "m/s"},
     {"velocity through the water y", "m/s"},
     {"velocity through the water z", "m/s"},
     {"position north", "m"},
     {"position east", "m"},
     {"velocity north", "m/s"},
     {"velocity east", "m/s"}}};

[[nodiscard]] constexpr const ChannelDescription& describe(Channel channel) {
  return kChannelDescriptions[static_cast<std::size_t>(channel)];
}

}  // namespace navcal::identify
