// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/channel_collector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/durations.h"

namespace navcal::analysis {
namespace {

constexpr double kSettling_s = 10, kFixPause_s = 10;

}  // namespace

void ChannelCollector::on_sample(const instruments::Sample& sample) {
  if (!begin_ns_) begin_ns_ = sample.stamp.validity_ns;
  const double time_s = base::seconds(sample.stamp.validity_ns - *begin_ns_);
  end_s_ = std::max(end_s_, time_s);
  begin_utc_ns_ = sample.stamp.validity_utc_ns - (sample.stamp.validity_ns - *begin_ns_);
  ChannelOrigin origin;
  if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value); gps != nullptr) {
    if (!is_settled(sample.port, *gps, time_s)) return;
    origin = receivers_[sample.port].origin;
  }
  const auto table = noise_channels();
  if (const auto* scalar = std::get_if<instruments::ScalarSample>(&sample.value); scalar != nullptr) {
    add({sample.port, table.size(), std::string(scalar->quantity.view())}, scalar->unit.view(), time_s,
        scalar->value);
    return;
  }
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (const auto value = table[i].value(sample, origin))
      add({sample.port, i, std::string(table[i].name)}, table[i].unit, time_s, *value);
  }
}

std::vector<RecordedChannel> ChannelCollector::take_channels(const config::Settings& settings) {
  std::vector<RecordedChannel> channels;
  for (auto& [key, kept] : std::exchange(channels_, {}))
    channels.push_back(
        {settings.ports.at(key.port).name, key.quantity, kept.unit, &row_of(key), std::move(kept.series), {}});
  return channels;
}

const NoiseChannel& ChannelCollector::row_of(const Key& key) {
  return key.row < noise_channels().size() ? noise_channels()[key.row] : scalar_channel();
}

bool ChannelCollector::is_settled(std::uint16_t port, const instruments::GpsSample& gps, double time_s) {
  const bool has_position = gps.latitude_rad && gps.longitude_rad && gps.fix != instruments::Fix::none;
  auto found = receivers_.find(port);
  if (found == receivers_.end()) {
    if (!has_position) return false;
    const ChannelOrigin origin{*gps.latitude_rad, *gps.longitude_rad};
    found = receivers_.emplace(port, Receiver{origin, time_s, time_s}).first;
  }
  Receiver& receiver = found->second;
  if (has_position) {
    if (time_s - receiver.newest_s > kFixPause_s) receiver.first_s = time_s;
    receiver.newest_s = time_s;
  }
  return receiver.newest_s - receiver.first_s >= kSettling_s;
}

void ChannelCollector::add(Key key, std::string_view unit, double time_s, double value) {
  if (!std::isfinite(value)) return;
  const bool is_angle = row_of(key).is_angle;
  auto& [kept_unit, series] = channels_[std::move(key)];
  if (kept_unit.empty()) kept_unit = unit;
  // Whole turns are added, so that steps of the readings stay exact.
  if (is_angle && !series.values.empty()) value += 360 * std::round((series.values.back() - value) / 360);
  series.time_s.push_back(time_s);
  series.values.push_back(value);
}

}  // namespace navcal::analysis
