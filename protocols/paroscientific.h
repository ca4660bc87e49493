// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Paroscientific Digiquartz pressure gauges: lines `*DDSStext<CR><LF>`, DD the receiver's and SS the sender's
/// number of two digits; the host has 00. Manual, not at hand (ICD): "Digiquartz Programming and Operation Manual"
/// (ICD section 14). The lines have no checksum: a damaged digit is not noticed. Therefore only lines of the
/// shapes below are frames. No capture was at hand.
namespace navcal::protocols::paroscientific {

/// A bare number: what P3 and P4 answer, and what other commands that measure answer.
inline constexpr FrameId kValue{"VALUE"};
/// Commands and their answers have the two letters of the command: `*0100UN` and `*0001UN=2`.
inline constexpr FrameId kUnits{"UN"}, kContinuous{"P4"};

inline constexpr std::uint8_t kHost = 0, kFirstGauge = 1;

struct Scanner : StartsWith<'*'> {
  static constexpr std::size_t kMaxFrameLength = 48;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// The two numbers that begin each line.
struct Address {
  std::uint8_t to = 0, from = 0;
  bool operator==(const Address&) const = default;
};
/// `frame` is one that Scanner found.
[[nodiscard]] Address address_of(Bytes frame);

/// The number of a VALUE line. nullopt for a line that is none, and for a number without a decimal point, which no
/// pressure is.
[[nodiscard]] std::optional<double> decode_value(Bytes frame);
/// Text behind `=` of an answer; empty without one, as in a command.
[[nodiscard]] std::string_view parameter_of(Bytes frame);

/// Pascals of one unit by the number that UN states: 1 psi, 2 hPa, 3 bar, 4 kPa, 5 MPa, 6 inHg, 7 mmHg, 8 m of
/// water. nullopt for others: 0 is a unit that the owner of the gauge has defined.
[[nodiscard]] std::optional<double> unit_Pa(int code);

/// `*DDSStext<CR><LF>`
[[nodiscard]] std::vector<std::uint8_t> encode_line(Address address, std::string_view text);

}  // namespace navcal::protocols::paroscientific
