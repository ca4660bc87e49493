// SPDX-License-Identifier: Apache-2.0
#include "protocols/oncore_messages.h"

#include <algorithm>

#include "protocols/oncore.h"
#include "protocols/wire_fields.h"

namespace navcal::protocols::oncore {
namespace {

bool is(Bytes frame, char first, char second) {
  return frame.size() >= 4 && frame[2] == first && frame[3] == second &&
         frame.size() == response_length(frame[2], frame[3]);
}

constexpr std::size_t kTail = 3;  // checksum, CR, LF

}  // namespace

std::optional<VisibleSatellites> decode_bb(Bytes frame) {
  if (!is(frame, 'B', 'b')) return std::nullopt;
  VisibleSatellites out;
  out.visible = frame[4];
  out.count = std::min<std::size_t>(out.visible, VisibleSatellites::kSlots);
  out.in_range = true;
  for (std::size_t i = 0; i < out.count; ++i) {
    const std::uint8_t* const p = frame.data() + 5 + 7 * i;
    out.satellites[i] = {p[0], get_be<std::int16_t>(p + 1), p[3], get_be<std::uint16_t>(p + 4), p[6]};
    out.in_range = out.in_range && p[3] <= 90 && get_be<std::uint16_t>(p + 4) <= 360;
  }
  return out;
}

std::optional<UtcOffset> decode_bo(Bytes frame) {
  if (!is(frame, 'B', 'o')) return std::nullopt;
  const auto offset_s = static_cast<std::int8_t>(frame[4]);
  return offset_s == 0 ? UtcOffset{} : UtcOffset{offset_s};
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

}  // namespace navcal::protocols::oncore
