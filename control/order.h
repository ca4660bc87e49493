// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "protocols/motor_card.h"

/// Right to command the motor card, and the orders sent to it. The types use no clock, port or file: every call
/// brings its time, nanoseconds of the monotonic clock.
namespace navcal::control {

inline constexpr std::int64_t kNever_ns = INT64_MAX;

/// One order of a controller, in the card's units (ICD section 4).
struct Order {
  double shaft_rpm = 0;
  std::array<double, 3> fins_deg{};

  bool operator==(const Order&) const = default;
};

/// Why the order exceeds the limits of the configuration or is not a number; empty when it is within them.
[[nodiscard]] std::string beyond_limits(const Order& order, const config::CommandSettings& settings);

/// The order in whole revolutions and tenths of degrees, as the line carries them.
[[nodiscard]] protocols::motor_card::Command rounded_for_card(const Order& order);

/// Cause of a line on the wire.
enum class Source : std::uint8_t {
  order,  ///< an order that has just come
  ramp,   ///< the way to it, as fast as the slew rates allow
  safe,   ///< the safe state
};
/// "order", "ramp", "safe".
[[nodiscard]] std::string_view name_of(Source source);

/// One line for the card.
struct Line {
  protocols::motor_card::Command command;
  Source source = Source::order;
};

/// Result of a line, or of an order that made none.
enum class Outcome : std::uint8_t {
  echoed,      ///< a status has shown it
  superseded,  ///< another line was sent before a status showed it
  not_echoed,  ///< no status has shown it in time
  refused,     ///< never sent
};
/// "echoed", "superseded", "not_echoed", "refused".
[[nodiscard]] std::string_view name_of(Outcome outcome);

/// Record of one line, or of one refusal (docs/log-format.md, /command).
struct OrderRecord {
  Outcome outcome = Outcome::refused;
  Source source = Source::order;
  std::uint64_t sequence = 0;  ///< of the newest order taken
  std::string holder;          ///< who is in charge, or asked; may be empty
  std::optional<int> priority;
  std::optional<std::int64_t> asked_ns, sent_ns, echoed_ns;  ///< monotonic
  std::optional<double> late_s;                              ///< after the STATE that the order answers
  Order wanted;
  std::optional<protocols::motor_card::Command> sent;
  std::string reason;               ///< of a refusal
  std::uint64_t refused_since = 0;  ///< refusals before this one that have no record
};

}  // namespace navcal::control
