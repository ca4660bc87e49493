// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Inertial measurement card, binary, card to host only (ICD section 3).
namespace navcal::protocols::imu_card {

inline constexpr FrameId kImu{"IMU"};
inline constexpr std::uint8_t kSync0 = 0xA5;
inline constexpr std::uint8_t kSync1 = 0x5A;
inline constexpr std::size_t kFrameLength = 22;

/// A sync pair may occur inside a frame, so a frame is one only by its CRC.
struct Scanner : StartsWith<kSync0> {
  static constexpr std::size_t kMaxFrameLength = kFrameLength;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

enum StatusBit : std::uint8_t { leak_forward = 1, leak_aft = 2, over_range = 4, low_supply = 8 };

/// One record as the card says it.
struct Record {
  std::uint8_t sequence = 0;           ///< +1 per frame, wraps 255 to 0
  std::uint8_t status = 0;             ///< StatusBit; bits 4 to 7 have no meaning yet
  std::array<std::uint16_t, 8> raw{};  ///< filtered readings in 1/16 converter counts; 16 = 1 mV

  bool operator==(const Record&) const = default;
};

/// The record in an intact frame; nullopt only when `frame` is none (length, sync or CRC).
[[nodiscard]] std::optional<Record> decode_record(Bytes frame);
[[nodiscard]] std::array<std::uint8_t, kFrameLength> encode_record(const Record& record);

}  // namespace navcal::protocols::imu_card
