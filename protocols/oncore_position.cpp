// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_position.h"

#include <cstdlib>

#include "protocols/oncore.h"
#include "protocols/oncore_ascii.h"
#include "protocols/units.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

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
