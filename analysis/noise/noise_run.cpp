// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/noise_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/noise/channel_collector.h"
#include "analysis/port_matching.h"
#include "base/failure.h"
#include "base/progress.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

/// Samples as the devices send them.
config::Settings plain(config::Settings settings) {
  settings.calibration.enabled = settings.navigation.enabled = settings.battery.enabled = false;
  for (auto& port : settings.ports) {
    port.mounting = {};
    port.gps.course_gate_m_s = 0;
  }
  return settings;
}

void play_into(ChannelCollector& collector, const std::string& file, const config::Settings& settings,
               std::vector<std::string>& remarks) {
  const auto recording = record::Recording::open(file);
  const auto ports = match_ports(recording->settings(), settings, file);
  pipeline::Pipeline pipeline(settings);
  base::Progress progress("noise");
  std::int64_t newest_ns = 0;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) newest_ns = std::max(newest_ns, raw->time_ns);
    ports.give(*entry, pipeline, collector, newest_ns);
    progress.show(recording->progress());
  }
  pipeline.advance(newest_ns, collector);
  remarks = recording->remarks();  // each names the file
}

std::vector<Interval> chosen_interval(const NoiseRequest& request, double duration_s) {
  const Interval chosen{request.from_s.value_or(0), std::min(request.to_s.value_or(duration_s), duration_s)};
  if (chosen.length_s() > 0 && chosen.from_s >= 0) return {chosen};
  throw base::Failure(
      base::Exit::usage,
      fmt::format("--from and --to leave nothing of the recording, which is {:.1f} s long", duration_s));
}

}  // namespace

QuietParts quiet_parts_of(const std::vector<RecordedChannel>& channels, double duration_s) {
  std::vector<MotionChannel> motion;
  for (const RecordedChannel& recorded : channels) {
    const NoiseChannel& channel = *recorded.channel;
    if (channel.slow_limit > 0)
      motion.push_back(
          {recorded.name(), std::string(channel.unit), &recorded.series, channel.slow_limit, channel.mean_limit});
  }
  return quiet_parts(motion, duration_s);
}

NoiseReport noise_of(const NoiseRequest& request, const config::Settings& settings) {
  const config::Settings used = plain(settings);
  NoiseReport report;
  report.file = request.file;
  ChannelCollector collector;
  play_into(collector, request.file, used, report.remarks);
  report.duration_s = collector.duration_s();
  report.begin_utc_ns = collector.begin_utc_ns();
  report.channels = collector.take_channels(used);
  report.chosen = request.from_s || request.to_s;
  if (report.chosen) {
    report.quiet = chosen_interval(request, report.duration_s);
  } else {
    QuietParts parts = quiet_parts_of(report.channels, report.duration_s);
    report.quiet = std::move(parts.intervals);
    report.quietest = std::move(parts.quietest);
  }
  for (RecordedChannel& recorded : report.channels) recorded.noise = channel_noise(recorded.series, report.quiet);
  return report;
}

}  // namespace navcal::analysis
