// SPDX-License-Identifier: Apache-2.0
#include "record/export/sensor_places.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "protocols/decimal.h"
#include "record/json/flat_json.h"
#include "record/json/mapping_json.h"
#include "record/log/log_reader.h"
#include "record/log/log_utc.h"

namespace navcal::record {
namespace {

PositionTrack track_of(const std::filesystem::path& log_file) {
  LogReader log(open_file(log_file), log_file.string());
  LogUtc utc(log_file);
  PositionTrack track;
  while (const auto message = log.next()) {
    const std::string& topic = log.channels().at(message->channel).topic;
    if (topic != "/nav" && topic != "/time") continue;
    const auto json = FlatJson::parse(utc.on_scale(*message, log));
    if (!json) continue;
    const auto time_ns = nanoseconds(json->get("time"));
    const auto lat = protocols::real(json->get("lat")), lon = protocols::real(json->get("lon"));
    if (time_ns && lat && lon) track.add(*time_ns, {*lat, *lon});
  }
  return track;
}

/// From -180 to 180.
double wrapped_degrees(double angle) { return std::remainder(angle, 360.0); }

}  // namespace

std::optional<PlaceInDegrees> PositionTrack::at(std::int64_t utc_ns) const {
  const auto after = places_.lower_bound(utc_ns);
  if (after == places_.end()) return std::nullopt;
  if (after->first == utc_ns) return after->second;
  if (after == places_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const std::int64_t apart_ns = after->first - before->first;
  if (apart_ns > kFarthest_ns) return std::nullopt;
  const double part = static_cast<double>(utc_ns - before->first) / static_cast<double>(apart_ns);
  // The shorter way round, where a track crosses the date line.
  const double east = wrapped_degrees(after->second.lon - before->second.lon);
  return PlaceInDegrees{before->second.lat + part * (after->second.lat - before->second.lat),
                        wrapped_degrees(before->second.lon + part * east)};
}

std::string SensorPlaces::placed(std::string_view json) {
  if (!track_) track_ = track_of(log_file_);
  const auto members = FlatJson::parse(json);
  const auto time_ns = members ? nanoseconds(members->get("time")) : std::nullopt;
  const auto place = time_ns ? track_->at(*time_ns) : std::nullopt;
  if (!place) return std::string(json);
  return fmt::format("{{\"lat\":{},\"lon\":{},{}", place->lat, place->lon, json.substr(1));
}

}  // namespace navcal::record
