// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "config/roles.h"
#include "instruments/samples.h"

namespace navcal::analysis {

/// Where the positions of a receiver are counted from.
struct ChannelOrigin {
  double latitude_rad = 0, longitude_rad = 0;
};

/// One channel of an instrument: a number that its samples may have, in the unit that people use for it. A new
/// channel is one row of the table in channels.cpp.
struct NoiseChannel {
  std::string_view name;
  std::string_view unit;
  std::optional<double> (*value)(const instruments::Sample&, const ChannelOrigin&);
  bool is_angle = false;  ///< degrees that go round: to be unwrapped
  /// The channel shows motion: the standard deviation of its means over a second that passes for rest. 0: it does
  /// not.
  double slow_limit = 0;
  std::optional<double> mean_limit{};  ///< at rest; nullopt: any mean
  std::string_view setting{};          ///< key of [instruments] with its noise, in the same unit; empty: none
  std::optional<config::Role> role{};  ///< the port that serves it gives the setting
};

[[nodiscard]] std::span<const NoiseChannel> noise_channels();

/// A mission sensor, whose samples have a name and a unit of their own.
[[nodiscard]] const NoiseChannel& scalar_channel();

}  // namespace navcal::analysis
