// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_command.h"

#include <algorithm>
#include <cmath>

#include "protocols/checked_line.h"
#include "protocols/oncore_encode.h"
#include "protocols/units.h"
#include "protocols/utc.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

constexpr std::array kWithRate{kHa, kHb, kEa, kBa, kBb, kBo, kHn, kEq};
constexpr std::array kWithoutRate{kCf, kCj, kGj};

FrameId id_of(const std::uint8_t* frame) {
  const char letters[2] = {static_cast<char>(frame[2]), static_cast<char>(frame[3])};
  return FrameId(std::string_view(letters, 2));
}

template <class List>
bool contains(const List& list, FrameId id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

std::size_t command_length(FrameId id) {
  if (contains(kWithRate, id)) return 8;
  if (id == kGa) return kGaLength;
  if (id == kGb) return kGbLength;
  return contains(kWithoutRate, id) ? 7 : 0;
}

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

std::vector<std::uint8_t> encode_poll(FrameId id, std::uint8_t rate) {
  return contains(kWithoutRate, id) ? encode_frame(id, {}) : encode_frame(id, Bytes(&rate, 1));
}

Scan CommandScanner::scan(const std::uint8_t* first, const std::uint8_t* last) {
  const auto available = static_cast<std::size_t>(last - first);
  if (available >= 2 && first[1] != '@') return Scan::not_a_frame();
  if (available < 4) return Scan::incomplete(7 - available);
  const FrameId id = id_of(first);
  const std::size_t length = command_length(id);
  if (length == 0) return Scan::not_a_frame();
  if (available < length) return Scan::incomplete(length - available);
  const bool intact = xor_of(Bytes(first + 2, length - 5)) == first[length - 3] && first[length - 2] == '\r' &&
                      first[length - 1] == '\n';
  return intact ? Scan::frame(length, id) : Scan::bad_checksum();
}

std::optional<Command> parse_command(Bytes frame) {
  const Scan found = CommandScanner::scan(frame.data(), frame.data() + frame.size());
  if (found.kind != Scan::Kind::frame || found.length != frame.size() || frame[0] != '@') return std::nullopt;
  if (contains(kWithoutRate, found.id)) return Command{found.id, std::nullopt};
  if (!contains(kWithRate, found.id)) return std::nullopt;
  return Command{found.id, frame[4]};
}

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
