// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/noise/channel_noise.h"
#include "analysis/noise/channels.h"
#include "analysis/noise/quiet.h"
#include "config/settings.h"

namespace navcal::analysis {

/// A channel of one port with all its readings.
struct RecordedChannel {
  std::string port;
  std::string quantity, unit;  ///< those of the channel; of a mission sensor its own
  const NoiseChannel* channel = nullptr;
  Series series;       ///< times in seconds from the beginning of the recording
  ChannelNoise noise;  ///< within the quiet parts

  [[nodiscard]] std::string name() const { return port + "." + quantity; }
};

struct NoiseReport {
  std::string file;
  double duration_s = 0;
  std::int64_t begin_utc_ns = 0;
  std::vector<Interval> quiet;
  bool chosen = false;  ///< the user gave the interval
  std::optional<QuietestWindow> quietest;
  std::vector<RecordedChannel> channels;  ///< in the order of ports and table
  std::vector<std::string> remarks;
};

struct NoiseRequest {
  std::string file;
  std::optional<double> from_s, to_s;  ///< from the beginning; either makes the interval chosen
};

/// The parts at rest by the channels that show motion.
[[nodiscard]] QuietParts quiet_parts_of(const std::vector<RecordedChannel>& channels, double duration_s);

/// Plays a recording through the pipeline and analyses every channel of every port in the axes of its device: the
/// mounting of the settings is left out. Throws record::BadRecording, and Failure (usage) for an interval that is
/// empty or outside the recording.
[[nodiscard]] NoiseReport noise_of(const NoiseRequest& request, const config::Settings& settings);

}  // namespace navcal::analysis
