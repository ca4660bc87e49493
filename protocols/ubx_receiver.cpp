// SPDX-License-Identifier: Apache-2.0
#include "protocols/ubx_receiver.h"

#include <algorithm>

#include "protocols/wire_fields.h"

namespace navcal::protocols::ubx {
namespace {

constexpr std::size_t kSoftwareLength = 30, kHardwareLength = 10, kExtensionLength = 30;
constexpr std::size_t kPulseLength = 16;
constexpr double kPulseFraction_ms = 1.0 / 4294967296.0;
constexpr std::uint8_t kPulseUtc = 1, kPulseQuantizationInvalid = 0x10;

std::string text_in(Bytes field) {
  const auto end = std::find(field.begin(), field.end(), std::uint8_t{0});
  std::string text(field.begin(), end);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

void append_text(std::vector<std::uint8_t>& payload, const std::string& text, std::size_t length) {
  const std::size_t begin = payload.size();
  payload.resize(begin + length);
  std::copy_n(text.begin(), std::min(text.size(), length), payload.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace

std::optional<Version> decode_mon_ver(Bytes frame) {
  const auto payload = payload_if(frame, kMonVer, kSoftwareLength + kHardwareLength);
  if (!payload) return std::nullopt;
  Bytes rest = *payload;
  Version version{
      text_in(rest.first(kSoftwareLength)), text_in(rest.subspan(kSoftwareLength, kHardwareLength)), {}};
  for (rest = rest.subspan(kSoftwareLength + kHardwareLength); rest.size() >= kExtensionLength;
       rest = rest.subspan(kExtensionLength)) {
    version.extensions.push_back(text_in(rest.first(kExtensionLength)));
  }
  return version;
}

std::vector<std::uint8_t> encode_mon_ver(const Version& version) {
  std::vector<std::uint8_t> payload;
  append_text(payload, version.software, kSoftwareLength);
  append_text(payload, version.hardware, kHardwareLength);
  for (const std::string& extension : version.extensions) append_text(payload, extension, kExtensionLength);
  return encode_frame(kMonVer, payload);
}

std::optional<TimePulse> decode_tim_tp(Bytes frame) {
  const auto payload = payload_if(frame, kTimTp, kPulseLength);
  if (!payload) return std::nullopt;
  const Bytes p = *payload;
  return TimePulse{get_le<std::uint32_t>(&p[0]), get_le<std::uint32_t>(&p[4]) * kPulseFraction_ms,
                   get_le<std::int32_t>(&p[8]),  get_le<std::uint16_t>(&p[12]),
                   (p[14] & kPulseUtc) != 0,     (p[14] & kPulseQuantizationInvalid) == 0};
}

}  // namespace navcal::protocols::ubx
