// SPDX-License-Identifier: Apache-2.0
#include "config/command_options.h"

namespace navcal::config {

std::vector<Option<Settings>> command_options() {
  using S = Settings;
  const NumberOf<S> number{"command"};
  return {
      boolean<S>(
          {.table = "command",
           .key = "enabled",
           .description = "Whether the control socket takes orders to the motor card at all."},
          [](auto& s) -> auto& { return s.command.enabled; }),
      number(
          "max_rpm",
          "Greatest shaft speed that an order may ask for, ahead and astern; beyond it the order is refused.",
          kCardRpm, 0, 100000, [](auto& s) -> auto& { return s.command.max_rpm; }),
      number(
          "max_fin_deg", "Likewise of a fin's angle, either way. The card itself refuses more than 25.",
          kCardDegrees, 0, 25, [](auto& s) -> auto& { return s.command.max_fin_deg; }),
      number(
          "slew_rpm_s", "How fast the shaft speed on the wire moves towards the order; 0: at once.",
          kCardRpmPerSecond, 0, 1e6, [](auto& s) -> auto& { return s.command.slew_rpm_s; }),
      number(
          "slew_fin_deg_s", "Likewise each fin's angle.", kCardDegreesPerSecond, 0, 1e4,
          [](auto& s) -> auto& { return s.command.slew_fin_deg_s; }),
      number(
          "min_timeout_s", "Shortest time without an order that a controller may choose for its lease.", kSeconds,
          0.05, 60, [](auto& s) -> auto& { return s.command.min_timeout_s; }),
      number(
          "max_timeout_s",
          "Longest time without an order that it may choose: so long may the shaft turn unattended.", kSeconds,
          0.05, 3600, [](auto& s) -> auto& { return s.command.max_timeout_s; }),
      number(
          "max_orders_Hz", "Orders taken in a second; those beyond it are refused.", kHertz, 1, 200,
          [](auto& s) -> auto& { return s.command.max_orders_Hz; }),
      number(
          "echo_timeout_s",
          "A card that has not shown an order for this long raises the alarm command_not_echoed; 0: not watched.",
          kSeconds, 0, 5, [](auto& s) -> auto& { return s.command.echo_timeout_s; }),
      number(
          "safe_rpm", "Shaft speed ordered when a lease ends and nobody takes over.", kCardRpm, -100000, 100000,
          [](auto& s) -> auto& { return s.command.safe_rpm; }),
      channels<S>(
          {.table = "command",
           .key = "safe_fins_deg",
           .description = "Fin angles ordered then.",
           .unit = kCardDegrees,
           .low = -25,
           .high = 25,
           .count = 3},
          [](auto& s) -> auto& { return s.command.safe_fins_deg; }),
      choice<S>(
          {.table = "command",
           .key = "on_leak",
           .description = "What a leak does beside its alarm: nothing, or the leases of programs end and the safe "
                          "state is ordered.",
           .choices = {"alarm", "safe"}},
          [](auto& s) -> auto& { return s.command.on_leak; }),
      integer<S>(
          {.table = "command",
           .key = "operator_priority",
           .description = "A lease of this priority or more is a person's: no leak ends it or forbids it.",
           .low = 0,
           .high = 1001},
          [](auto& s) -> auto& { return s.command.operator_priority; }),
  };
}

}  // namespace navcal::config
