// SPDX-License-Identifier: Apache-2.0
#include "control/order.h"

#include <fmt/format.h>

#include <cmath>

namespace navcal::control {

std::string beyond_limits(const Order& order, const config::CommandSettings& settings) {
  if (!std::isfinite(order.shaft_rpm)) return "shaft_rpm is no number";
  if (std::abs(order.shaft_rpm) > settings.max_rpm)
    return fmt::format("shaft_rpm {} is beyond {}", order.shaft_rpm, settings.max_rpm);
  for (std::size_t i = 0; i < order.fins_deg.size(); ++i) {
    if (!std::isfinite(order.fins_deg[i])) return fmt::format("fins_deg[{}] is no number", i);
    if (std::abs(order.fins_deg[i]) > settings.max_fin_deg)
      return fmt::format("fins_deg[{}] {} is beyond {}", i, order.fins_deg[i], settings.max_fin_deg);
  }
  return {};
}

protocols::motor_card::Command rounded_for_card(const Order& order) {
  protocols::motor_card::Command command;
  command.rpm = static_cast<std::int32_t>(std::lround(order.shaft_rpm));
  // Adding 0 makes a negative zero a plain one.
  for (std::size_t i = 0; i < order.fins_deg.size(); ++i)
    command.fins_deg[i] = std::round(order.fins_deg[i] * 10) / 10 + 0.0;
  return command;
}

std::string_view name_of(Source source) {
  switch (source) {
    case Source::order: return "order";
    case Source::ramp: return "ramp";
    case Source::safe: break;
  }
  return "safe";
}

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::echoed: return "echoed";
    case Outcome::superseded: return "superseded";
    case Outcome::not_echoed: return "not_echoed";
    case Outcome::refused: break;
  }
  return "refused";
}

}  // namespace navcal::control
