// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_encode.h"

#include <algorithm>
#include <cmath>

#include "protocols/checked_line.h"
#include "protocols/oncore.h"
#include "protocols/units.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

class Data {
 public:
  explicit Data(FrameId id) : id_(id) { bytes_.reserve(kMaxLength); }

  void u8(std::uint8_t value) { bytes_.push_back(value); }
  void u16(std::uint16_t value) { append_be(bytes_, value); }
  void u32(std::uint32_t value) { append_be(bytes_, value); }
  void scaled_u16(double value, double per_unit) {
    u16(static_cast<std::uint16_t>(std::clamp(std::lround(value * per_unit), 0L, 65535L)));
  }
  void scaled_i32(double value, double per_unit) {
    u32(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * per_unit))));
  }
  void zeros(std::size_t n) { bytes_.insert(bytes_.end(), n, 0); }
  [[nodiscard]] std::vector<std::uint8_t> frame() const { return encode_frame(id_, bytes_); }

 private:
  FrameId id_;
  std::vector<std::uint8_t> bytes_;
};

void put(Data& data, const Coordinates& place) {
  data.scaled_i32(place.latitude_deg, kMilliarcsecondsPerDegree);
  data.scaled_i32(place.longitude_deg, kMilliarcsecondsPerDegree);
  data.scaled_i32(place.height_m, 100);
  data.scaled_i32(place.height_msl_m.value_or(0), 100);
}

void put_time_and_place(Data& data, const Position& position) {
  data.u8(position.date.month);
  data.u8(position.date.day);
  data.u16(position.date.year);
  data.u8(position.time.hour);
  data.u8(position.time.minute);
  data.u8(position.time.second);
  data.u32(position.time.nanosecond);
  put(data, position.filtered);
}

// A heading that rounds up to 360.0 is 0.
void put_heading(Data& data, double heading_deg) {
  data.u16(static_cast<std::uint16_t>(std::lround(heading_deg * 10) % 3600));
}

std::uint16_t twelve_channel_status(const Position& position) {
  if (position.status) return *position.status;
  constexpr std::array<unsigned, 7> kBits{0, 6, 7, 5, 4, 3, 2};  // in the order of Fix
  const unsigned flags = (position.no_almanac ? 0x80U : 0U) | (position.few_satellites ? 0x08U : 0U);
  const auto antenna = static_cast<unsigned>(position.antenna.value_or(Antenna::ok));
  return static_cast<std::uint16_t>(kBits[static_cast<std::size_t>(position.fix)] << 13 | flags | antenna << 1);
}

std::uint8_t eight_channel_status(const Position& position) {
  if (position.status) return static_cast<std::uint8_t>(*position.status);
  constexpr std::array<unsigned, 7> kBits{0, 0x10, 0x20, 0x80, 0x08, 0x08, 0x40};  // in the order of Fix
  const unsigned flags = (position.few_satellites ? 0x02U : 0U) | (position.no_almanac ? 0x01U : 0U);
  return static_cast<std::uint8_t>(kBits[static_cast<std::size_t>(position.fix)] | flags);
}

std::uint8_t utc_byte(const Position& position) {
  if (!position.utc) return 0;
  return static_cast<std::uint8_t>((position.utc->enabled ? 0x80 : 0) | (position.utc->decoded ? 0x40 : 0) |
                                   (position.utc->offset_s & 0x3F));
}

}  // namespace

std::vector<std::uint8_t> encode_frame(FrameId id, Bytes data) {
  std::vector<std::uint8_t> frame{'@', '@'};
  frame.reserve(data.size() + 7);
  for (const char letter : id.view()) frame.push_back(static_cast<std::uint8_t>(letter));
  frame.insert(frame.end(), data.begin(), data.end());
  frame.push_back(xor_of(Bytes(frame).subspan(2)));
  frame.push_back('\r');
  frame.push_back('\n');
  return frame;
}

std::vector<std::uint8_t> encode_ha(const Position& position) {
  Data data(kHa);
  put_time_and_place(data, position);
  put(data, position.unfiltered.value_or(position.filtered));
  data.scaled_u16(position.speed_3d_m_s.value_or(position.speed_m_s), 100);
  data.scaled_u16(position.speed_m_s, 100);
  put_heading(data, position.heading_deg);
  data.scaled_u16(position.dop, 10);
  data.u8(position.visible.value_or(position.tracked));
  data.u8(position.tracked);
  for (const Channel& channel : position.channels) {
    data.u8(channel.satellite);
    data.u8(channel.mode);
    data.u8(channel.cn0);
    data.u8(channel.iode.value_or(0));
    data.u16(channel.status);
  }
  data.u16(twelve_channel_status(position));
  data.zeros(2);
  data.u16(static_cast<std::uint16_t>(position.clock_bias_ns.value_or(0)));
  data.u32(position.oscillator_offset_Hz.value_or(0));
  data.u16(
      static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(position.temperature_C.value_or(0) * 2))));
  data.u8(utc_byte(position));
  data.zeros(3);
  for (const char c : position.id_tag.value_or(std::array<char, 6>{})) data.u8(static_cast<std::uint8_t>(c));
  return data.frame();
}

std::vector<std::uint8_t> encode_ea(const Position& position) {
  Data data(kEa);
  put_time_and_place(data, position);
  data.scaled_u16(position.speed_m_s, 100);
  put_heading(data, position.heading_deg);
  data.scaled_u16(position.dop, 10);
  const auto antenna = static_cast<unsigned>(position.antenna.value_or(Antenna::ok));
  data.u8(static_cast<std::uint8_t>(antenna << 6 | (position.fix == Fix::fix_2d ? 1U : 0U)));
  data.u8(position.visible.value_or(position.tracked));
  data.u8(position.tracked);
  for (std::size_t i = 0; i < 8; ++i) {
    const Channel& channel = position.channels[i];
    data.u8(channel.satellite);
    data.u8(channel.mode);
    data.u8(channel.cn0);
    data.u8(static_cast<std::uint8_t>(channel.status));
  }
  data.u8(eight_channel_status(position));
  return data.frame();
}

std::vector<std::uint8_t> encode_bb(const VisibleSatellites& satellites) {
  Data data(kBb);
  data.u8(satellites.visible);
  for (const auto& satellite : satellites.satellites) {
    data.u8(satellite.number);
    data.u16(static_cast<std::uint16_t>(satellite.doppler_Hz));
    data.u8(satellite.elevation_deg);
    data.u16(satellite.azimuth_deg);
    data.u8(satellite.health);
  }
  return data.frame();
}

std::vector<std::uint8_t> encode_bo(const UtcOffset& offset) {
  Data data(kBo);
  data.u8(static_cast<std::uint8_t>(offset.offset_s.value_or(0)));
  return data.frame();
}

std::vector<std::uint8_t> encode_cj(std::string_view text) {
  constexpr std::size_t kText = kMaxLength - 7;
  Data data(kCj);
  for (std::size_t i = 0; i < kText; ++i) data.u8(i < text.size() ? static_cast<std::uint8_t>(text[i]) : ' ');
  return data.frame();
}

}  // namespace navcal::protocols::oncore
