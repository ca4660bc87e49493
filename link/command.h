// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "link/frame.h"

namespace navcal::link {

/// What an operator asks of the motor. Only the newest command counts: one that arrives after a newer one is
/// dropped.
struct Command {
  enum class Kind : std::uint8_t { lease = 1, order = 2, release = 3, stop = 4 };
  Kind kind = Kind::release;
  std::uint16_t number = 0;  ///< grows by one with every command of a session, and wraps
  // Of a lease.
  std::uint16_t priority = 0;
  double timeout_s = 0;  ///< in steps of 10 ms
  std::string holder{};  ///< its first 64 bytes; of a stop: who stops
  // Of an order.
  double shaft_rpm = 0;              ///< whole
  std::array<double, 3> fins_deg{};  ///< in steps of 0.01 deg

  bool operator==(const Command&) const = default;
};

struct CommandAnswer {
  std::uint16_t number = 0;  ///< of the command
  bool is_ok = false;
  bool is_shaped = false;     ///< of an order: slew rates keep it from being reached at once
  std::string error;          ///< its first 160 bytes
  bool is_in_charge = false;  ///< the operator holds the lease after the command

  bool operator==(const CommandAnswer&) const = default;
};

[[nodiscard]] Buffer encode_command(const Command& command);
[[nodiscard]] std::optional<Command> decode_command(Bytes payload);
[[nodiscard]] Buffer encode_answer(const CommandAnswer& answer);
[[nodiscard]] std::optional<CommandAnswer> decode_answer(Bytes payload);

}  // namespace navcal::link
