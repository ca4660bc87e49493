// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace navcal::protocols {

using Bytes = std::span<const std::uint8_t>;

/// The name of a kind of frame as people write it: "Ea", "WORD", "GPGGA", "PTNTHTM"; at most sixteen characters.
/// Its size is fixed, so that it copies and compares without memory of its own.
class FrameId {
 public:
  constexpr FrameId() = default;
  constexpr explicit FrameId(std::string_view text) {
    for (std::size_t i = 0; i < text.size() && i < text_.size(); ++i) text_[i] = text[i];
  }
  [[nodiscard]] constexpr std::string_view view() const {
    std::size_t n = 0;
    while (n < text_.size() && text_[n] != '\0') ++n;
    return {text_.data(), n};
  }
  constexpr auto operator<=>(const FrameId&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs

 private:
  std::array<char, 16> text_{};
};

/// One intact frame. `bytes` is valid only during the call that hands it over.
struct Frame {
  FrameId id;
  std::uint64_t offset = 0;  ///< of its first byte in the stream
  Bytes bytes;               ///< all of it, framing included

  [[nodiscard]] std::uint64_t end() const { return offset + bytes.size(); }
};

/// Every byte of a stream is in exactly one place: bytes = framed + skipped + held by the parser.
struct Counters {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;
  std::uint64_t bad_checksum = 0;  ///< candidates of full length whose checksum (or terminator) did not hold
  std::uint64_t framed_bytes = 0;
  std::uint64_t skipped_bytes = 0;
};

enum class Protocol : std::uint8_t {
  tcm2,
  imu_card,
  oncore,
  motor_card,
  nmea,
  ubx,
  mip,
  vectornav,
  pni,
  pd0,
  pd6,
  water_linked,
  samples,
  paroscientific,
  keller,
  described,
  mavlink
};

/// The name in the device's row: "tcm2", "imu-card", "ubx", ... (docs/cli.md, ICD section 5).
[[nodiscard]] std::string_view name_of(Protocol protocol);
[[nodiscard]] std::optional<Protocol> protocol_named(std::string_view name);

}  // namespace navcal::protocols
