// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_position.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "protocols/decimal.h"
#include "protocols/oncore.h"
#include "protocols/oncore_encode.h"
#include "protocols/units.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

// Columns are fixed:
// @@Eq,mm,dd,yy,hh,mm,ss,dd,mm.mmmm,n,ddd,mm.mmmm,w,shhhhh.h,sss.s,hhh.h,m,t,dd.d,nn,rrrr,aa,CCC
class Columns {
 public:
  explicit Columns(std::string_view text) : text_(text) {}

  double number(std::size_t at, std::size_t width) {
    std::string_view field = text_.substr(at, width);
    if (field.front() == '+') field.remove_prefix(1);
    const auto value = decimal(field);
    readable_ = readable_ && value && text_[at + width] == ',';
    return value.value_or(0);
  }
  unsigned count(std::size_t at, std::size_t width) {
    const double value = number(at, width);
    readable_ = readable_ && value >= 0;
    return readable_ ? static_cast<unsigned>(value) : 0;
  }
  char letter(std::size_t at) {
    readable_ = readable_ && text_[at + 1] == ',';
    return text_[at];
  }
  [[nodiscard]] bool readable() const { return readable_; }

 private:
  std::string_view text_;
  bool readable_ = true;
};

Fix fix_of(char type) {
  switch (type) {
    case '1': return Fix::fix_2d;
    case '2': return Fix::fix_3d;
    case '3': return Fix::propagated;
    default: return Fix::none;
  }
}

std::optional<Position> decode_eq(Bytes frame) {
  if (frame.size() != response_length('E', 'q')) return std::nullopt;
  Columns columns(std::string_view(reinterpret_cast<const char*>(frame.data()), frame.size()));
  const auto small = [&](std::size_t at) { return static_cast<std::uint8_t>(columns.count(at, 2)); };

  Position out;
  out.date = {full_year(columns.count(11, 2)), small(5), small(8)};
  out.time = {small(14), small(17), small(20), 0};
  const double latitude_minutes = columns.number(26, 7);
  const double longitude_minutes = columns.number(40, 7);
  out.filtered.latitude_deg = columns.count(23, 2) + latitude_minutes / 60;
  out.filtered.longitude_deg = columns.count(36, 3) + longitude_minutes / 60;
  const char north = columns.letter(34);
  const char east = columns.letter(48);
  out.filtered.height_m = columns.number(50, 8);
  out.speed_m_s = columns.number(59, 5) * kMetresPerSecondPerKnot;
  out.heading_deg = columns.number(65, 5);
  out.fix = fix_of(columns.letter(73));
  out.dop = columns.number(75, 4);
  out.tracked = small(80);
  if (!columns.readable() || (north != 'N' && north != 'S') || (east != 'E' && east != 'W')) return std::nullopt;

  out.in_range = is_valid(out.date) && is_valid(out.time) && latitude_minutes < 60 && longitude_minutes < 60 &&
                 out.filtered.latitude_deg <= 90 && out.filtered.longitude_deg <= 180 && out.heading_deg < 360;
  if (north == 'S') out.filtered.latitude_deg = -out.filtered.latitude_deg;
  if (east == 'W') out.filtered.longitude_deg = -out.filtered.longitude_deg;
  return out;
}

constexpr double kMostHeading_deg = 359.9, kMostDop = 99.9;

// The layouts of Ha, Hb, Ea and Ba. Optional members have a value where the message has them.

template <class Layout, class Place>
void lay_out(const Layout& p, std::size_t at, Place& place) {
  p.template parts<std::int32_t>(at, place.latitude_deg, kMilliarcsecondsPerDegree);
  p.template parts<std::int32_t>(at + 4, place.longitude_deg, kMilliarcsecondsPerDegree);
  p.template parts<std::int32_t>(at + 8, place.height_m, 100);
  p.template parts<std::int32_t>(at + 12, *place.height_msl_m, 100);
}

void heading(const LayoutReader& p, std::size_t at, double& heading_deg) {
  p.parts<std::uint16_t>(at, heading_deg, 10);
}
/// A heading that rounds up to 360.0 is 0.
void heading(const LayoutWriter& p, std::size_t at, double heading_deg) {
  p.number(at, static_cast<std::uint16_t>(std::lround(heading_deg * 10) % 3600));
}

/// Date, time and place stand at the same offsets in all; speed, heading, DOP and counts follow one another.
template <class Layout, class Of>
void lay_out_common(const Layout& p, Of& position, std::size_t speed, std::size_t counts) {
  p.number(4, position.date.month);
  p.number(5, position.date.day);
  p.number(6, position.date.year);
  p.number(8, position.time.hour);
  p.number(9, position.time.minute);
  p.number(10, position.time.second);
  p.number(11, position.time.nanosecond);
  lay_out(p, 15, position.filtered);
  p.template parts<std::uint16_t>(speed, position.speed_m_s, 100);
  heading(p, speed + 2, position.heading_deg);
  p.template parts<std::uint16_t>(speed + 4, position.dop, 10);
  p.number(counts, *position.visible);
  p.number(counts + 1, position.tracked);
}

void six_bits(const LayoutReader& p, std::size_t at, std::int8_t& number) {
  p.bits(at, 0, 6, number);
  if (number >= 32) number = static_cast<std::int8_t>(number - 64);
}
void six_bits(const LayoutWriter& p, std::size_t at, std::int8_t number) { p.bits(at, 0, 6, number); }

template <class Layout, class Of>
void lay_out_ha(const Layout& p, Of& position) {
  lay_out_common(p, position, 49, 55);
  lay_out(p, 31, *position.unfiltered);
  p.template parts<std::uint16_t>(47, *position.speed_3d_m_s, 100);
  for (std::size_t i = 0; i < 12; ++i) {
    auto& channel = position.channels[i];
    const std::size_t at = 57 + 6 * i;
    p.number(at, channel.satellite);
    p.number(at + 1, channel.mode);
    p.number(at + 2, channel.cn0);
    p.number(at + 3, *channel.iode);
    p.number(at + 4, channel.status);
  }
  p.number(129, *position.status);
  p.number(133, *position.clock_bias_ns);
  p.number(135, *position.oscillator_offset_Hz);
  p.template parts<std::int16_t>(139, *position.temperature_C, 2);
  p.bits(141, 7, 1, position.utc->enabled);
  p.bits(141, 6, 1, position.utc->decoded);
  six_bits(p, 141, position.utc->offset_s);
  for (std::size_t i = 0; i < position.id_tag->size(); ++i) p.number(145 + i, (*position.id_tag)[i]);
}

/// But for the byte of the antenna.
template <class Layout, class Of>
void lay_out_ea(const Layout& p, Of& position, std::size_t channels) {
  lay_out_common(p, position, 31, 38);
  for (std::size_t i = 0; i < channels; ++i) {
    auto& channel = position.channels[i];
    const std::size_t at = 40 + 4 * i;
    p.number(at, channel.satellite);
    p.number(at + 1, channel.mode);
    p.number(at + 2, channel.cn0);
    p.bits(at + 3, 0, 8, channel.status);
  }
  p.bits(40 + 4 * channels, 0, 8, *position.status);
}

Position with_all_of_ha(Position position) {
  if (!position.unfiltered) position.unfiltered = position.filtered;
  for (Coordinates* const place : {&position.filtered, &*position.unfiltered})
    place->height_msl_m = place->height_msl_m.value_or(0);
  position.speed_3d_m_s = position.speed_3d_m_s.value_or(position.speed_m_s);
  position.visible = position.visible.value_or(position.tracked);
  for (Channel& channel : position.channels) channel.iode = channel.iode.value_or(0);
  position.status = position.status.value_or(0);
  position.clock_bias_ns = position.clock_bias_ns.value_or(0);
  position.oscillator_offset_Hz = position.oscillator_offset_Hz.value_or(0);
  position.temperature_C = position.temperature_C.value_or(0);
  position.utc = position.utc.value_or(UtcState{});
  position.id_tag = position.id_tag.value_or(std::array<char, 6>{});
  return position;
}

template <class LayOut>
std::vector<std::uint8_t> encoded(FrameId id, const Position& position, LayOut lay_out_message) {
  const std::string_view letters = id.view();
  std::vector<std::uint8_t> frame(
      response_length(static_cast<std::uint8_t>(letters[0]), static_cast<std::uint8_t>(letters[1])));
  lay_out_message(LayoutWriter(frame, true), position);
  return encode_frame(id, Bytes(frame).subspan(4, frame.size() - 7));
}

/// What the three highest bits of the status of Ha and Hb say, and the flags of Ea and Ba, in the order of Fix. Of
/// the flags what speaks against the position counts first. Bit 3 is acquiring or position hold without saying
/// which: the reading that claims less is taken.
constexpr std::array<unsigned, 7> kTwelveChannelFix{0, 6, 7, 5, 4, 3, 2},
    kEightChannelFix{0, 0x10, 0x20, 0x80, 0x08, 0x08, 0x40};

Fix fix_of_twelve_channels(std::uint16_t status) {
  const auto found = std::find(kTwelveChannelFix.begin() + 1, kTwelveChannelFix.end(), status >> 13);
  return found == kTwelveChannelFix.end() ? Fix::none : static_cast<Fix>(found - kTwelveChannelFix.begin());
}

Fix fix_of_eight_channels(unsigned status) {
  for (const Fix fix : {Fix::propagated, Fix::bad_geometry, Fix::fix_3d, Fix::fix_2d, Fix::acquiring}) {
    if ((status & kEightChannelFix[static_cast<std::size_t>(fix)]) != 0) return fix;
  }
  return Fix::none;
}

std::uint16_t twelve_channel_status(const Position& position) {
  if (position.status) return *position.status;
  const unsigned flags = (position.no_almanac ? 0x80U : 0U) | (position.few_satellites ? 0x08U : 0U);
  const auto antenna = static_cast<unsigned>(position.antenna.value_or(Antenna::ok));
  return static_cast<std::uint16_t>(kTwelveChannelFix[static_cast<std::size_t>(position.fix)] << 13 | flags |
                                    antenna << 1);
}

std::uint16_t eight_channel_status(const Position& position) {
  if (position.status) return *position.status;
  const unsigned flags = (position.few_satellites ? 0x02U : 0U) | (position.no_almanac ? 0x01U : 0U);
  return static_cast<std::uint16_t>(kEightChannelFix[static_cast<std::size_t>(position.fix)] | flags);
}

bool place_in_range(const Coordinates& place) {
  return std::abs(place.latitude_deg) <= 90 && std::abs(place.longitude_deg) <= 180;
}

bool in_range(const Position& position) {
  return is_valid(position.date) && is_valid(position.time) && place_in_range(position.filtered) &&
         position.heading_deg <= kMostHeading_deg && position.dop <= kMostDop &&
         (!position.unfiltered || place_in_range(*position.unfiltered));
}

/// Of Ha and Hb.
void take_status(std::uint16_t status, Position& out) {
  out.status = status;
  out.fix = fix_of_twelve_channels(status);
  out.no_almanac = (status & 0x80U) != 0;
  out.few_satellites = (status & 0x08U) != 0;
  out.antenna = static_cast<Antenna>(status >> 1U & 3U);
}

Position decode_ha(Bytes frame) {
  Position out = with_all_of_ha({});
  lay_out_ha(LayoutReader(frame, true), out);
  out.channel_count = 12;
  take_status(*out.status, out);
  out.in_range = in_range(out);
  return out;
}

Position decode_hb(Bytes frame) {
  Position out;
  out.filtered.height_msl_m.emplace();
  out.visible.emplace();
  const LayoutReader p(frame, true);
  lay_out_common(p, out, 33, 39);
  p.parts<std::uint16_t>(31, out.speed_3d_m_s.emplace(), 100);
  p.number(41, out.status.emplace());
  take_status(*out.status, out);
  auto& tag = out.id_tag.emplace();
  std::copy_n(frame.begin() + 45, tag.size(), tag.begin());
  out.in_range = in_range(out);
  return out;
}

// Ea with eight channels, Ba with six.
Position decode_ea(Bytes frame, std::size_t channels) {
  Position out;
  out.filtered.height_msl_m.emplace();
  out.visible.emplace();
  out.status.emplace();
  lay_out_ea(LayoutReader(frame, true), out, channels);
  out.channel_count = channels;
  out.antenna = static_cast<Antenna>(frame[37] >> 6U);
  out.fix = fix_of_eight_channels(*out.status);
  out.few_satellites = (*out.status & 0x02U) != 0;
  out.no_almanac = (*out.status & 0x01U) != 0;
  out.in_range = in_range(out);
  return out;
}

}  // namespace

std::optional<Position> decode_position(Bytes frame) {
  if (frame.size() < 4 || frame.size() != response_length(frame[2], frame[3])) return std::nullopt;
  switch (frame[2] << 8 | frame[3]) {
    case 'H' << 8 | 'a': return decode_ha(frame);
    case 'H' << 8 | 'b': return decode_hb(frame);
    case 'E' << 8 | 'a': return decode_ea(frame, 8);
    case 'B' << 8 | 'a': return decode_ea(frame, 6);
    case 'E' << 8 | 'q': return decode_eq(frame);
    default: return std::nullopt;
  }
}

std::vector<std::uint8_t> encode_ha(const Position& position) {
  Position sent = with_all_of_ha(position);
  sent.status = twelve_channel_status(position);
  return encoded(kHa, sent, [](const auto& p, const Position& of) { lay_out_ha(p, of); });
}

std::vector<std::uint8_t> encode_ea(const Position& position) {
  Position sent = with_all_of_ha(position);
  sent.status = eight_channel_status(position);
  return encoded(kEa, sent, [](const auto& p, const Position& of) {
    lay_out_ea(p, of, 8);
    p.bits(37, 6, 2, of.antenna.value_or(Antenna::ok));
    p.bits(37, 0, 1, of.fix == Fix::fix_2d);
  });
}

}  // namespace navcal::protocols::oncore
