// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "analysis/import/import_sink.h"
#include "analysis/import/motor_channels.h"

namespace navcal::analysis {

/// Whether a file is an MCAP file that navcal has not written.
[[nodiscard]] bool is_ros_bag(std::string_view head);

/// ROS 2 bag in an MCAP file, messages in CDR. Axes of REP-103 (forward, left, up; east, north, up) become those
/// of navcal (forward, starboard, down; north, east, down). The stamp of a message's header is its time of
/// validity where it lies within an hour of the time at which it was logged. Chunks may be compressed with lz4 or
/// zstd. `channels` become shaft and fins. docs/import.md has the table of messages.
[[nodiscard]] ImportFindings read_ros_bag(std::string_view file, ImportSink& sink, MotorChannels& channels);

}  // namespace navcal::analysis
