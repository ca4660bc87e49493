// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/motor_channels.h"

namespace navcal::analysis {

/// Whether a file begins with a time of this century and an intact MAVLink frame.
[[nodiscard]] bool is_mavlink_log(std::string_view head);

/// MAVLink telemetry log (.tlog): frames of version 1 or 2, each behind the UTC of the computer that received it,
/// eight bytes, big endian, in microseconds. instruments::MavlinkDecoder reads them, as it does live. `channels`
/// become shaft and fins. docs/import.md has the table.
/// `undoes_calibration`: takes the autopilot's own calibration off the fields, where the log has its parameters.
[[nodiscard]] ImportFindings read_mavlink_log(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                              bool undoes_calibration = true);

}  // namespace navcal::analysis
