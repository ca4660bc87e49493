// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocols/ubx.h"

/// The receiver itself and its time pulse (u-blox interface descriptions M8 and F9, sections "UBX-MON-VER" and
/// "UBX-TIM-TP"; layout in ICD section 6).
namespace navcal::protocols::ubx {

/// MON-VER. An empty message asks for it.
struct Version {
  std::string software, hardware;
  std::vector<std::string> extensions;  ///< "FWVER=HPG 1.32", "PROTVER=27.31", "MOD=ZED-F9P", ...
  bool operator==(const Version&) const = default;
};
[[nodiscard]] std::optional<Version> decode_mon_ver(Bytes frame);
/// Texts are cut to 30, 10 and 30 characters.
[[nodiscard]] std::vector<std::uint8_t> encode_mon_ver(const Version& version);

/// TIM-TP: the next time pulse.
struct TimePulse {
  std::uint32_t time_of_week_ms = 0;
  double fraction_ms = 0;  ///< added to it
  std::int32_t quantization_ps =
      0;  ///< by which the pulse comes early or late, since it lies on the receiver's clock
  std::uint16_t week = 0;
  bool is_utc = false;  ///< the time base is UTC, not a satellite system's
  bool quantization_valid = false;
  bool operator==(const TimePulse&) const = default;
};
[[nodiscard]] std::optional<TimePulse> decode_tim_tp(Bytes frame);

}  // namespace navcal::protocols::ubx
