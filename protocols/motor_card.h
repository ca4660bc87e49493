// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocols/frame.h"
#include "protocols/stream_parser.h"

/// Motor controller card, ASCII both ways (ICD section 4).
namespace navcal::protocols::motor_card {

inline constexpr FrameId kMcs{"MCS"};  ///< status, card to host
inline constexpr FrameId kMcc{"MCC"};  ///< command, host to card

/// Lines that begin `$MCS,` or `$MCC,`; any other line is not a frame.
struct Scanner : StartsWith<'$'> {
  /// The longest status that makes sense is 60 bytes (six-digit speeds, three-digit angles and currents); at 19200
  /// baud 96 bytes are 50 ms, half the time between two status lines.
  static constexpr std::size_t kMaxFrameLength = 96;
  static Scan scan(const std::uint8_t* first, const std::uint8_t* last);
};
using Parser = StreamParser<Scanner>;

/// Values reported by the card; an empty field is absent.
struct Status {
  std::optional<std::uint8_t> sequence;  ///< +1 per line, wraps 255 to 0
  std::optional<std::int32_t> rpm_commanded;
  std::optional<std::int32_t> rpm;  ///< of the shaft, from the encoder
  std::array<std::optional<double>, 3> fins_deg;
  std::optional<double> current_A;  ///< of the propulsion motor

  bool operator==(const Status&) const = default;
};

struct Command {
  std::int32_t rpm = 0;
  std::array<double, 3> fins_deg{};

  bool operator==(const Command&) const = default;
};

/// The card rejects a command whose fins lie beyond +- this.
inline constexpr double kFinLimit_deg = 25.0;
/// Resolution of fin angles and of the current on the wire.
inline constexpr double kFinStep_deg = 0.1, kCurrentStep_A = 0.01;

/// Decodes an intact MCS or MCC line; nullopt if the number of fields is wrong, a field is not a number, or a
/// field of a command is empty.
[[nodiscard]] std::optional<Status> decode_status(Bytes frame);
[[nodiscard]] std::optional<Command> decode_command(Bytes frame);

/// Fins with one decimal, current with two.
[[nodiscard]] std::vector<std::uint8_t> encode_status(const Status& status);
[[nodiscard]] std::vector<std::uint8_t> encode_command(const Command& command);

}  // namespace navcal::protocols::motor_card
