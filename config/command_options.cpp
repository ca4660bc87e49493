// SPDX-License-Identifier: Apache-2.0
#include "config/command_options.h"

namespace navcal::config {

std::vector<Option<Settings>> command_options() {
  using S = Settings;
  return {
      boolean<S>(
          {.table = "command",
           .key = "enabled",
           .description = "Whether the control socket takes orders to the motor card at all."},
          [](auto& s) -> auto& { return s.command.enabled; }),
      real<S>(
          {.table = "command",
           .key = "max_rpm",
           .description =
               "Greatest shaft speed that an order may ask for, ahead and astern; beyond it the order is "
               "refused.",
           .unit = kCardRpm,
           .low = 0,
           .high = 100000},
          [](auto& s) -> auto& { return s.command.max_rpm; }),
      real<S>(
          {.table = "command",
           .key = "max_fin_deg",
           .description = "Likewise of a fin's angle, either way. The card itself refuses more than 25.",
           .unit = kCardDegrees,
           .low = 0,
           .high = 25},
          [](auto& s) -> auto& { return s.command.max_fin_deg; }),
      real<S>(
          {.table = "command",
           .key = "slew_rpm_s",
           .description = "How fast the shaft speed on the wire moves towards the order; 0: at once.",
           .unit = kCardRpmPerSecond,
           .low = 0,
           .high = 1e6},
          [](auto& s) -> auto& { return s.command.slew_rpm_s; }),
      real<S>(
          {.table = "command",
           .key = "slew_fin_deg_s",
           .description = "Likewise each fin's angle.",
           .unit = kCardDegreesPerSecond,
           .low = 0,
           .high = 1e4},
          [](auto& s) -> auto& { return s.command.slew_fin_deg_s; }),
      real<S>(
          {.table = "command",
           .key = "min_timeout_s",
           .description = "Shortest time without an order that a controller may choose for its lease.",
           .unit = kSeconds,
           .low = 0.05,
           .high = 60},
          [](auto& s) -> auto& { return s.command.min_timeout_s; }),
      real<S>(
          {.table = "command",
           .key = "max_timeout_s",
           .description =
               "Longest time without an order that it may choose: so long may the shaft turn unattended.",
           .unit = kSeconds,
           .low = 0.05,
           .high = 3600},
          [](auto& s) -> auto& { return s.command.max_timeout_s; }),
      real<S>(
          {.table = "command",
           .key = "max_orders_Hz",
           .description = "Orders taken in a second; those beyond it are refused.",
           .unit = kHertz,
           .low = 1,
           .high = 200},
          [](auto& s) -> auto& { return s.command.max_orders_Hz; }),
      real<S>(
          {.table = "command",
           .key = "echo_timeout_s",
           .description =
               "A card that has not shown an order for this long raises the alarm command_not_echoed; 0: not "
               "watched.",
           .unit = kSeconds,
           .low = 0,
           .high = 5},
          [](auto& s) -> auto& { return s.command.echo_timeout_s; }),
      real<S>(
          {.table = "command",
           .key = "safe_rpm",
           .description = "Shaft speed ordered when a lease ends and nobody takes over.",
           .unit = kCardRpm,
           .low = -100000,
           .high = 100000},
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
