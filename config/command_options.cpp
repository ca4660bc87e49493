// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"

namespace navcal::config {

std::vector<Option<Settings>> command_options() {
  const auto table = table_of<Settings>("command", &Settings::command);
  return {
      table.boolean("enabled", &CommandSettings::enabled,
                    "Whether the control socket takes orders to the motor card at all."),
      table.number(
          "max_rpm", &CommandSettings::max_rpm, kCardRpm, 0, 100000,
          "Greatest shaft speed that an order may ask for, ahead and astern; beyond it the order is refused."),
      table.number("max_fin_deg", &CommandSettings::max_fin_deg, kCardDegrees, 0, 25,
                   "Likewise of a fin's angle, either way. The card itself refuses more than 25."),
      table.number("slew_rpm_s", &CommandSettings::slew_rpm_s, kCardRpmPerSecond, 0, 1e6,
                   "How fast the shaft speed on the wire moves towards the order; 0: at once."),
      table.number("slew_fin_deg_s", &CommandSettings::slew_fin_deg_s, kCardDegreesPerSecond, 0, 1e4,
                   "Likewise each fin's angle."),
      table.number("min_timeout_s", &CommandSettings::min_timeout_s, kSeconds, 0.05, 60,
                   "Shortest time without an order that a controller may choose for its lease."),
      table.number("max_timeout_s", &CommandSettings::max_timeout_s, kSeconds, 0.05, 3600,
                   "Longest time without an order that it may choose: so long may the shaft turn unattended."),
      table.number("max_orders_Hz", &CommandSettings::max_orders_Hz, kHertz, 1, 200,
                   "Orders taken in a second; those beyond it are refused."),
      table.number(
          "echo_timeout_s", &CommandSettings::echo_timeout_s, kSeconds, 0, 5,
          "A card that has not shown an order for this long raises the alarm command_not_echoed; 0: not watched."),
      table.number("safe_rpm", &CommandSettings::safe_rpm, kCardRpm, -100000, 100000,
                   "Shaft speed ordered when a lease ends and nobody takes over."),
      table.channels("safe_fins_deg", &CommandSettings::safe_fins_deg, kCardDegrees, -25, 25,
                     "Fin angles ordered then."),
      table.choice("on_leak", &CommandSettings::on_leak, {"alarm", "safe"},
                   "What a leak does beside its alarm: nothing, or the leases of programs end and the safe state "
                   "is ordered."),
      table.integer("operator_priority", &CommandSettings::operator_priority, kNoUnit, 0, 1001,
                    "A lease of this priority or more is a person's: no leak ends it or forbids it."),
  };
}

}  // namespace navcal::config
