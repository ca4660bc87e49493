// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/noise_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/failure.h"
#include "analysis/port_matching.h"
#include "analysis/progress.h"
#include "base/durations.h"
#include "pipeline/pipeline.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

/// Fixes after a search that are noisier than settled ones.
constexpr int kUnsettledFixes = 10;

/// Samples as the devices send them.
config::Settings plain(config::Settings settings) {
  settings.calibration.enabled = settings.navigation.enabled = settings.battery.enabled = false;
  for (auto& port : settings.ports) {
    port.mounting = {};
    port.gps.course_gate_m_s = 0;
  }
  return settings;
}

class ChannelCollector final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override {
    if (!begin_ns_) begin_ns_ = sample.stamp.validity_ns;
    const double time_s = base::seconds(sample.stamp.validity_ns - *begin_ns_);
    end_s_ = std::max(end_s_, time_s);
    begin_utc_ns_ = sample.stamp.validity_utc_ns - (sample.stamp.validity_ns - *begin_ns_);
    if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value); gps != nullptr) {
      if (!is_settled(sample.port, *gps)) return;
    }
    if (const auto* scalar = std::get_if<instruments::ScalarSample>(&sample.value); scalar != nullptr) {
      add({sample.port, noise_channels().size(), std::string(scalar->quantity.view())}, scalar->unit.view(),
          time_s, scalar->value);
      return;
    }
    const auto table = noise_channels();
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (const auto value = table[i].value(sample, origins_[sample.port]))
        add({sample.port, i, std::string(table[i].name)}, table[i].unit, time_s, *value);
    }
  }

  [[nodiscard]] double duration_s() const { return end_s_; }
  [[nodiscard]] std::int64_t begin_utc_ns() const { return begin_utc_ns_; }
  std::vector<RecordedChannel> channels(const config::Settings& settings) && {
    std::vector<RecordedChannel> channels;
    for (auto& [key, kept] : channels_)
      channels.push_back(
          {settings.ports[key.port].name, key.quantity, kept.unit, &row_of(key), std::move(kept.series), {}});
    return channels;
  }

 private:
  struct Key {
    std::uint16_t port = 0;
    std::size_t row = 0;  ///< of the table; after its end: a mission sensor
    std::string quantity;
    auto operator<=>(const Key&) const = default;
  };
  struct Kept {
    std::string unit;
    Series series;
  };

  static const NoiseChannel& row_of(const Key& key) {
    return key.row < noise_channels().size() ? noise_channels()[key.row] : scalar_channel();
  }

  bool is_settled(std::uint16_t port, const instruments::GpsSample& gps) {
    int& fixes = fixes_[port];
    if (!gps.latitude_rad || !gps.longitude_rad || gps.fix == instruments::Fix::none) {
      fixes = 0;
      return false;
    }
    if (!origins_.contains(port))
      origins_[port] = {*gps.latitude_rad, *gps.longitude_rad, gps.height_m.value_or(0)};
    return ++fixes > kUnsettledFixes;
  }
  void add(Key key, std::string_view unit, double time_s, double value) {
    if (!std::isfinite(value)) return;
    const bool is_angle = row_of(key).is_angle;
    auto& [kept_unit, series] = channels_[std::move(key)];
    if (kept_unit.empty()) kept_unit = unit;
    // Whole turns are added, so that steps of the readings stay exact.
    if (is_angle && !series.values.empty()) value += 360 * std::round((series.values.back() - value) / 360);
    series.time_s.push_back(time_s);
    series.values.push_back(value);
  }

  std::optional<std::int64_t> begin_ns_;
  std::int64_t begin_utc_ns_ = 0;
  double end_s_ = 0;
  std::map<std::uint16_t, ChannelOrigin> origins_;
  std::map<std::uint16_t, int> fixes_;
  std::map<Key, Kept> channels_;
};

void play_into(ChannelCollector& collector, const std::string& file, const config::Settings& settings,
               std::vector<std::string>& remarks) {
  const auto recording = record::Recording::open(file);
  const auto ports = match_ports(recording->settings(), settings, file);
  pipeline::Pipeline pipeline(settings);
  Progress progress("noise");
  std::int64_t newest_ns = 0;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      newest_ns = std::max(newest_ns, raw->time_ns);
      const auto port = ports[raw->port];
      if (raw->direction == record::Direction::received && port)
        pipeline.bytes(*port, newest_ns, raw->bytes, collector);
    } else if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      pipeline.set_mapping(change->mapping, collector);
    }
    progress.show(recording->progress());
  }
  pipeline.advance(newest_ns, collector);
  remarks = recording->remarks();  // each names the file
}

std::vector<Interval> chosen_interval(const NoiseRequest& request, double duration_s) {
  const Interval chosen{request.from_s.value_or(0), std::min(request.to_s.value_or(duration_s), duration_s)};
  if (chosen.length_s() > 0 && chosen.from_s >= 0) return {chosen};
  throw Failure(Exit::usage,
                fmt::format("--from and --to leave nothing of the recording, which is {:.1f} s long", duration_s));
}

void find_quiet_parts(NoiseReport& report) {
  std::vector<MotionChannel> motion;
  for (const RecordedChannel& recorded : report.channels) {
    const NoiseChannel& channel = *recorded.channel;
    if (channel.slow_limit > 0)
      motion.push_back(
          {recorded.name(), std::string(channel.unit), &recorded.series, channel.slow_limit, channel.mean_limit});
  }
  QuietParts parts = quiet_parts(motion, report.duration_s);
  report.quiet = std::move(parts.intervals);
  report.quietest = std::move(parts.quietest);
}

}  // namespace

NoiseReport noise_of(const NoiseRequest& request, const config::Settings& settings) {
  const config::Settings used = plain(settings);
  NoiseReport report;
  report.file = request.file;
  ChannelCollector collector;
  play_into(collector, request.file, used, report.remarks);
  report.duration_s = collector.duration_s();
  report.begin_utc_ns = collector.begin_utc_ns();
  report.channels = std::move(collector).channels(used);
  report.chosen = request.from_s || request.to_s;
  if (report.chosen)
    report.quiet = chosen_interval(request, report.duration_s);
  else
    find_quiet_parts(report);
  for (RecordedChannel& recorded : report.channels) recorded.noise = channel_noise(recorded.series, report.quiet);
  return report;
}

}  // namespace navcal::analysis
