// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {

const std::vector<Option<PowerSettings>>& power_options() {
  const auto table = table_of<PowerSettings>("", std::identity());
  static const std::vector<Option<PowerSettings>> options{
      table.text("gpio_chip", &PowerSettings::gpio_chip, is_gpio_chip, "gpiochip0, or its path in /dev",
                 "GPIO controller of the line (`gpiodetect` lists them)."),
      table.integer("line", &PowerSettings::line, kNoUnit, 0, 1023,
                    "Number of the line on that controller (`gpioinfo` lists them)."),
      table.list("devices", &PowerSettings::devices, is_port_name, "the name of a port",
                 "Ports whose devices it feeds."),
      table.boolean("active_low", &PowerSettings::active_low, "Whether the low level of the line switches on."),
      table.choice("at_start", &PowerSettings::at_start, {"on", "off", "leave"},
                   "What a start of navcald does to the line; `leave` keeps it as it is."),
      table.number("settle_s", &PowerSettings::settle_s, kSeconds, 0, 600,
                   "Time from switching on until the start-up dialogues of the devices begin."),
  };
  return options;
}

}  // namespace navcal::config
