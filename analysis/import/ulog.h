// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/motor_channels.h"

namespace navcal::analysis {

[[nodiscard]] bool is_ulog(std::string_view head);

/// PX4's ULog (.ulg), by the definitions of its own messages. Times are microseconds since boot; UTC follows from
/// the receiver. PX4's body axes are those of navcal: forward, starboard, down. `channels` become
/// shaft and fins. docs/import.md has the table of
/// messages. The autopilot's own calibration of its compasses is undone where its parameters tell it.
[[nodiscard]] ImportFindings read_ulog(std::string_view file, ImportSink& sink, MotorChannels& channels,
                                       bool undoes_calibration = true);

}  // namespace navcal::analysis
