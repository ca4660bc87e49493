// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/import/motor_channels.h"

namespace navcal::analysis::testing {

/// Channels of a map whose pulses of 1100 to 1900 us are -1200 to 1200 rpm of the shaft, and -20 to 20 degrees of
/// the first fin.
inline MotorChannels pulses_of(const std::string& shaft, const std::string& fin) {
  constexpr const char* kCurve = "from = [1100, 1900]\nto = ";
  return MotorChannels(config::parse_channel_map(
      "[column.\"" + shaft + "\"]\nmeaning = \"rpm_commanded\"\n" + kCurve + "[-1200, 1200]\n[column.\"" + fin +
          "\"]\nmeaning = \"fin_1\"\nunit = \"deg\"\n" + kCurve + "[-20, 20]\n",
      "map.toml"));
}

}  // namespace navcal::analysis::testing
