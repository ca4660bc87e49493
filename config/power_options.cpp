// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

using Supply = PowerSettings;

std::vector<Option<Supply>> make_power_options() {
  return {
      text<Supply>(
          {.key = "gpio_chip",
           .description = "GPIO controller of the line (`gpiodetect` lists them).",
           .text_rule = "gpiochip0, or its path in /dev",
           .text_holds = is_gpio_chip},
          [](auto& p) -> auto& { return p.gpio_chip; }),
      integer<Supply>(
          {.key = "line",
           .description = "Number of the line on that controller (`gpioinfo` lists them).",
           .low = 0,
           .high = 1023},
          [](auto& p) -> auto& { return p.line; }),
      list<Supply>(
          {.key = "devices",
           .description = "Ports whose devices it feeds.",
           .text_rule = "the name of a port",
           .text_holds = is_port_name},
          [](auto& p) -> auto& { return p.devices; }),
      boolean<Supply>(
          {.key = "active_low", .description = "Whether the low level of the line switches on."},
          [](auto& p) -> auto& { return p.active_low; }),
      choice<Supply>(
          {.key = "at_start",
           .description = "What a start of navcald does to the line; `leave` keeps it as it is.",
           .choices = {"on", "off", "leave"}},
          [](auto& p) -> auto& { return p.at_start; }),
      real<Supply>(
          {.key = "settle_s",
           .description = "Time from switching on until the start-up dialogues of the devices begin.",
           .unit = kSeconds,
           .low = 0,
           .high = 600},
          [](auto& p) -> auto& { return p.settle_s; }),
  };
}

}  // namespace

const std::vector<Option<Supply>>& power_options() {
  static const std::vector<Option<Supply>> options = make_power_options();
  return options;
}

}  // namespace navcal::config
