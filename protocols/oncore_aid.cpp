// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_aid.h"

#include <algorithm>
#include <cmath>

#include "protocols/oncore_command.h"
#include "protocols/oncore_encode.h"
#include "protocols/units.h"
#include "protocols/utc.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

constexpr double kMostLatitude_deg = 90, kMostLongitude_deg = 180, kLeastHeight_m = -1000, kMostHeight_m = 18'000;
constexpr std::uint8_t kGpsHeight = 0;  // the height is above the ellipsoid

template <class Layout, class Position>
void lay_out_position(const Layout& p, Position& position) {
  p.template parts<std::int32_t>(0, position.latitude_deg, kMilliarcsecondsPerDegree);
  p.template parts<std::int32_t>(4, position.longitude_deg, kMilliarcsecondsPerDegree);
  p.template parts<std::int32_t>(8, position.height_m, 100);
}

bool is_command(Bytes frame, FrameId id, std::size_t length) {
  const Scan found = CommandScanner::scan(frame.data(), frame.data() + frame.size());
  return found.kind == Scan::Kind::frame && found.length == frame.size() && frame.size() == length &&
         frame[0] == '@' && found.id == id;
}

}  // namespace

std::vector<std::uint8_t> encode_aid_position(const AidPosition& position) {
  const AidPosition sent{std::clamp(position.latitude_deg, -kMostLatitude_deg, kMostLatitude_deg),
                         std::clamp(position.longitude_deg, -kMostLongitude_deg, kMostLongitude_deg),
                         std::clamp(position.height_m, kLeastHeight_m, kMostHeight_m)};
  std::vector<std::uint8_t> data(13, kGpsHeight);
  lay_out_position(LayoutWriter(data, true), sent);
  return encode_frame(kGa, data);
}

std::vector<std::uint8_t> encode_aid_time(std::int64_t utc_ns) {
  const Date date = date_of(utc_ns);
  const TimeOfDay time = time_of_day(utc_ns);
  const std::vector<std::uint8_t> data{date.month,
                                       date.day,
                                       static_cast<std::uint8_t>(date.year >> 8),
                                       static_cast<std::uint8_t>(date.year),
                                       time.hour,
                                       time.minute,
                                       time.second,
                                       0,
                                       0,
                                       0};
  return encode_frame(kGb, data);
}

std::optional<AidPosition> parse_aid_position(Bytes frame) {
  if (!is_command(frame, kGa, kGaLength)) return std::nullopt;
  AidPosition position;
  lay_out_position(LayoutReader(frame.subspan(4), true), position);
  const bool in_range = std::abs(position.latitude_deg) <= kMostLatitude_deg &&
                        std::abs(position.longitude_deg) <= kMostLongitude_deg &&
                        position.height_m >= kLeastHeight_m && position.height_m <= kMostHeight_m;
  if (!in_range || frame[16] != kGpsHeight) return std::nullopt;
  return position;
}

std::optional<std::int64_t> parse_aid_time(Bytes frame) {
  if (!is_command(frame, kGb, kGbLength)) return std::nullopt;
  const Date date{get_be<std::uint16_t>(&frame[6]), frame[4], frame[5]};
  const TimeOfDay time{frame[8], frame[9], frame[10], 0};
  const bool is_utc = frame[11] == 0 && frame[12] == 0 && frame[13] == 0;
  if (!is_utc || !is_valid(date) || !is_valid(time)) return std::nullopt;
  return unix_ns(date, time);
}

}  // namespace navcal::protocols::oncore
