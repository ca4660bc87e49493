// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_position.h"

#include <cstdlib>
#include <optional>
#include <string_view>

#include "protocols/decimal.h"
#include "protocols/oncore.h"
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

constexpr std::int64_t kMaxLatitude_mas = 324'000'000;
constexpr std::int64_t kMaxLongitude_mas = 648'000'000;
constexpr unsigned kMaxHeading = 3599;  // tenths of a degree
constexpr unsigned kMaxDop = 999;       // tenths

Coordinates coordinates(const std::uint8_t* p) {
  return {get_be<std::int32_t>(p) / kMilliarcsecondsPerDegree,
          get_be<std::int32_t>(p + 4) / kMilliarcsecondsPerDegree, get_be<std::int32_t>(p + 8) / 100.0,
          get_be<std::int32_t>(p + 12) / 100.0};
}

bool place_in_range(const std::uint8_t* p) {
  return std::llabs(get_be<std::int32_t>(p)) <= kMaxLatitude_mas &&
         std::llabs(get_be<std::int32_t>(p + 4)) <= kMaxLongitude_mas;
}

// Ha and Hb: the three highest bits are a number.
Fix fix_of_twelve_channels(std::uint16_t status) {
  switch (status >> 13) {
    case 7: return Fix::fix_3d;
    case 6: return Fix::fix_2d;
    case 5: return Fix::propagated;
    case 4: return Fix::hold;
    case 3: return Fix::acquiring;
    case 2: return Fix::bad_geometry;
    default: return Fix::none;
  }
}

// Ea and Ba: flags; what speaks against the position comes first. Bit 3 is acquiring or position hold without
// saying which: the reading that claims less is taken.
Fix fix_of_eight_channels(std::uint8_t status) {
  if ((status & 0x80U) != 0) return Fix::propagated;
  if ((status & 0x40U) != 0) return Fix::bad_geometry;
  if ((status & 0x20U) != 0) return Fix::fix_3d;
  if ((status & 0x10U) != 0) return Fix::fix_2d;
  if ((status & 0x08U) != 0) return Fix::acquiring;
  return Fix::none;
}

Antenna antenna_of(unsigned bits) {
  constexpr std::array<Antenna, 4> kMeaning{Antenna::ok, Antenna::shorted, Antenna::open, Antenna::unknown};
  return kMeaning[bits & 3U];
}

// Date, time and place stand at the same offsets in Ha, Hb and Ea; speed, heading, DOP and counts follow one
// another.
void read_common(const std::uint8_t* f, Position& out) {
  out.date = {get_be<std::uint16_t>(f + 6), f[4], f[5]};
  out.time = {f[8], f[9], f[10], get_be<std::uint32_t>(f + 11)};
  out.filtered = coordinates(f + 15);
  out.in_range = is_valid(out.date) && is_valid(out.time) && place_in_range(f + 15);
}

void read_motion(const std::uint8_t* speed, const std::uint8_t* counts, Position& out) {
  const std::uint16_t heading = get_be<std::uint16_t>(speed + 2);
  const std::uint16_t dop = get_be<std::uint16_t>(speed + 4);
  out.speed_m_s = get_be<std::uint16_t>(speed) / 100.0;
  out.heading_deg = heading / 10.0;
  out.dop = dop / 10.0;
  out.visible = counts[0];
  out.tracked = counts[1];
  out.in_range = out.in_range && heading <= kMaxHeading && dop <= kMaxDop;
}

void read_receiver_status(const std::uint8_t* p, Position& out) {
  const std::uint16_t status = get_be<std::uint16_t>(p);
  out.status = status;
  out.fix = fix_of_twelve_channels(status);
  out.no_almanac = (status & 0x80U) != 0;
  out.few_satellites = (status & 0x08U) != 0;
  out.antenna = antenna_of(status >> 1U);
}

void read_id_tag(const std::uint8_t* p, Position& out) {
  auto& tag = out.id_tag.emplace();
  for (std::size_t i = 0; i < tag.size(); ++i) tag[i] = static_cast<char>(p[i]);
}

std::int8_t six_bits_signed(std::uint8_t byte) {
  const int value = byte & 0x3F;
  return static_cast<std::int8_t>(value >= 32 ? value - 64 : value);
}

Position decode_ha(const std::uint8_t* f) {
  Position out;
  read_common(f, out);
  out.unfiltered = coordinates(f + 31);
  out.in_range = out.in_range && place_in_range(f + 31);
  out.speed_3d_m_s = get_be<std::uint16_t>(f + 47) / 100.0;
  read_motion(f + 49, f + 55, out);
  out.channel_count = 12;
  for (std::size_t i = 0; i < out.channel_count; ++i) {
    const std::uint8_t* const c = f + 57 + 6 * i;
    out.channels[i] = {c[0], c[1], c[2], c[3], get_be<std::uint16_t>(c + 4)};
  }
  read_receiver_status(f + 129, out);
  out.clock_bias_ns = get_be<std::int16_t>(f + 133);
  out.oscillator_offset_Hz = get_be<std::uint32_t>(f + 135);
  out.temperature_C = get_be<std::int16_t>(f + 139) / 2.0;
  out.utc = UtcState{(f[141] & 0x80) != 0, (f[141] & 0x40) != 0, six_bits_signed(f[141])};
  read_id_tag(f + 145, out);
  return out;
}

Position decode_hb(const std::uint8_t* f) {
  Position out;
  read_common(f, out);
  out.speed_3d_m_s = get_be<std::uint16_t>(f + 31) / 100.0;
  read_motion(f + 33, f + 39, out);
  read_receiver_status(f + 41, out);
  read_id_tag(f + 45, out);
  return out;
}

// Ea with eight channels, Ba with six.
Position decode_ea(const std::uint8_t* f, std::size_t channels) {
  Position out;
  read_common(f, out);
  read_motion(f + 31, f + 38, out);
  out.antenna = antenna_of(f[37] >> 6U);
  out.channel_count = channels;
  for (std::size_t i = 0; i < channels; ++i) {
    const std::uint8_t* const c = f + 40 + 4 * i;
    out.channels[i] = {c[0], c[1], c[2], std::nullopt, c[3]};
  }
  const std::uint8_t status = f[40 + 4 * channels];
  out.status = status;
  out.fix = fix_of_eight_channels(status);
  out.few_satellites = (status & 0x02U) != 0;
  out.no_almanac = (status & 0x01U) != 0;
  return out;
}

}  // namespace

std::optional<Position> decode_position(Bytes frame) {
  if (frame.size() < 4 || frame.size() != response_length(frame[2], frame[3])) return std::nullopt;
  switch (frame[2] << 8 | frame[3]) {
    case 'H' << 8 | 'a': return decode_ha(frame.data());
    case 'H' << 8 | 'b': return decode_hb(frame.data());
    case 'E' << 8 | 'a': return decode_ea(frame.data(), 8);
    case 'B' << 8 | 'a': return decode_ea(frame.data(), 6);
    case 'E' << 8 | 'q': return decode_eq(frame);
    default: return std::nullopt;
  }
}

}  // namespace navcal::protocols::oncore
