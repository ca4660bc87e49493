// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_messages.h"

#include <algorithm>

#include "protocols/oncore.h"
#include "protocols/oncore_encode.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

bool is(Bytes frame, std::uint8_t first, std::uint8_t second) {
  return frame.size() >= 4 && frame[2] == first && frame[3] == second &&
         frame.size() == response_length(frame[2], frame[3]);
}

constexpr std::size_t kTail = 3;  // checksum, CR, LF

template <class Layout, class Satellite>
void lay_out_satellite(const Layout& p, std::size_t at, Satellite& one) {
  p.number(at, one.number);
  p.number(at + 1, one.doppler_Hz);
  p.number(at + 3, one.elevation_deg);
  p.number(at + 4, one.azimuth_deg);
  p.number(at + 6, one.health);
}

}  // namespace

std::optional<VisibleSatellites> decode_bb(Bytes frame) {
  if (!is(frame, 'B', 'b')) return std::nullopt;
  VisibleSatellites out;
  out.visible = frame[4];
  out.count = std::min<std::size_t>(out.visible, VisibleSatellites::kSlots);
  out.in_range = true;
  for (std::size_t i = 0; i < out.count; ++i) {
    VisibleSatellites::Satellite& one = out.satellites[i];
    lay_out_satellite(LayoutReader(frame, true), 5 + 7 * i, one);
    out.in_range = out.in_range && one.elevation_deg <= 90 && one.azimuth_deg <= 360;
  }
  return out;
}

std::vector<std::uint8_t> encode_bb(const VisibleSatellites& satellites) {
  std::vector<std::uint8_t> data(1 + 7 * VisibleSatellites::kSlots);
  data[0] = satellites.visible;
  for (std::size_t i = 0; i < VisibleSatellites::kSlots; ++i)
    lay_out_satellite(LayoutWriter(data, true), 1 + 7 * i, satellites.satellites[i]);
  return encode_frame(kBb, data);
}

std::optional<UtcOffset> decode_bo(Bytes frame) {
  if (!is(frame, 'B', 'o')) return std::nullopt;
  const auto offset_s = static_cast<std::int8_t>(frame[4]);
  return offset_s == 0 ? UtcOffset{} : UtcOffset{offset_s};
}

std::vector<std::uint8_t> encode_bo(const UtcOffset& offset) {
  return encode_frame(kBo, std::array{static_cast<std::uint8_t>(offset.offset_s.value_or(0))});
}

std::optional<LeapAnnouncement> decode_gj(Bytes frame) {
  if (!is(frame, 'G', 'j')) return std::nullopt;
  const std::uint8_t* const f = frame.data();
  LeapAnnouncement out;
  out.present_s = static_cast<std::int8_t>(f[4]);
  out.future_s = static_cast<std::int8_t>(f[5]);
  out.date = {get_be<std::uint16_t>(f + 6), f[8], f[9]};
  out.time = {f[15], f[16], f[17], 0};
  out.in_range = is_valid(out.date) && is_valid(out.time);
  return out;
}

std::optional<TimeRaim> decode_hn(Bytes frame) {
  if (!is(frame, 'H', 'n')) return std::nullopt;
  const std::uint8_t* const f = frame.data();
  TimeRaim out;
  out.pulse_on = f[4] != 0;
  out.pulse_of_utc = f[5] != 0;
  if (f[6] == 0) out.solution = TimeRaim::Solution::ok;
  if (f[6] == 1) out.solution = TimeRaim::Solution::alarm;
  out.method = f[7];
  out.removed = get_be<std::uint32_t>(f + 8);
  out.accuracy_ns = get_be<std::uint16_t>(f + 12);
  out.sawtooth_ns = static_cast<std::int8_t>(f[14]);
  return out;
}

std::optional<std::string_view> decode_cj(Bytes frame) {
  if (!is(frame, 'C', 'j')) return std::nullopt;
  return std::string_view(reinterpret_cast<const char*>(frame.data()) + 4, frame.size() - 4 - kTail);
}

std::vector<std::uint8_t> encode_cj(std::string_view text) {
  std::vector<std::uint8_t> data(kMaxLength - 7, ' ');
  std::copy_n(text.begin(), std::min(text.size(), data.size()), data.begin());
  return encode_frame(kCj, data);
}

}  // namespace navcal::protocols::oncore
