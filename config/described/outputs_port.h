// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "config/settings.h"

namespace navcal::config {

/// Port, speed and latency of the lines that hold the outputs to the actuators of a layout.
inline constexpr std::string_view kOutputsPort = "outputs";
inline constexpr int kOutputsBaud = 115200;
inline constexpr double kOutputsLatency_s = 0.005;

/// Port "outputs" of the device that sends the lines $PNCAO with outputs 1 to 8, and $PNCAP with 9 to 16, in whole
/// us; a field is empty where there is no such output: "$PNCAO,1500,1620,1500,1500,,,,*52". With the text of
/// share/devices/actuator-outputs.toml, its description: a capture has no place for one.
[[nodiscard]] PortSettings outputs_port();
/// Text of that file.
[[nodiscard]] std::string_view outputs_description();

}  // namespace navcal::config
