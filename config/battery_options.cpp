// SPDX-License-Identifier: Apache-2.0
#include "config/battery_options.h"

#include <iterator>

namespace navcal::config {
namespace {

std::vector<Option<Settings>> pack_options() {
  using S = Settings;
  return {
      boolean<S>(
          {.table = "battery",
           .key = "enabled",
           .description = "Whether the charge of the battery is counted, reported and watched."},
          [](auto& s) -> auto& { return s.battery.enabled; }),
      real<S>(
          {.table = "battery",
           .key = "capacity_Ah",
           .description = "Charge that the full battery gives.",
           .unit = kAmpereHours,
           .low = 0.01,
           .high = 10000},
          [](auto& s) -> auto& { return s.battery.capacity_Ah; }),
      real<S>(
          {.table = "battery",
           .key = "nominal_V",
           .description = "Nominal voltage, by which a charge is told as an energy.",
           .unit = kVolts,
           .low = 0.1,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.nominal_V; }),
      channels<S>(
          {.table = "battery",
           .key = "curve_V",
           .description = "Open-circuit voltage at eight charges from empty to full, equally spaced. Eight zeros: "
                          "not known, and the voltage does not correct the charge.",
           .unit = kVolts,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.curve_V; }),
      real<S>(
          {.table = "battery",
           .key = "voltage_error_V",
           .description = "Error of that curve and of the voltage's gauge, one standard deviation.",
           .unit = kVolts,
           .low = 0.001,
           .high = 100},
          [](auto& s) -> auto& { return s.battery.voltage_error_V; }),
      real<S>(
          {.table = "battery",
           .key = "resistance_ohm",
           .description = "Internal resistance, which lowers the voltage under load.",
           .unit = kOhms,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.battery.resistance_ohm; }),
      real<S>(
          {.table = "battery",
           .key = "rest_A",
           .description = "Current up to which the battery rests.",
           .unit = kAmperes,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.rest_A; }),
      real<S>(
          {.table = "battery",
           .key = "rest_s",
           .description = "The voltage corrects the charge after so long a rest.",
           .unit = kSeconds,
           .low = 0,
           .high = 3600},
          [](auto& s) -> auto& { return s.battery.rest_s; }),
  };
}

std::vector<Option<Settings>> load_options() {
  using S = Settings;
  return {
      real<S>(
          {.table = "battery",
           .key = "hotel_A",
           .description =
               "Current of everything but the motor. It is added to the motor's while no gauge measures "
               "the whole current.",
           .unit = kAmperes,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.hotel_A; }),
      real<S>(
          {.table = "battery",
           .key = "hotel_error_A",
           .description = "Error of that current, one standard deviation.",
           .unit = kAmperes,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.hotel_error_A; }),
      real<S>(
          {.table = "battery",
           .key = "current_error_percent",
           .description = "Constant error of a measured current, one standard deviation.",
           .unit = kPercent,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.battery.current_error; }),
      real<S>(
          {.table = "battery",
           .key = "low_percent",
           .description = "The alarm battery_low is raised below this charge; 0: never.",
           .unit = kPercent,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.battery.low; }),
      real<S>(
          {.table = "battery",
           .key = "low_V",
           .description =
               "It is also raised when the measured voltage stays below this for five seconds; 0: never.",
           .unit = kVolts,
           .low = 0,
           .high = 1000},
          [](auto& s) -> auto& { return s.battery.low_V; }),
      real<S>(
          {.table = "battery",
           .key = "mean_s",
           .description = "Time constant of the mean load and speed, from which time and range left follow.",
           .unit = kSeconds,
           .low = 1,
           .high = 36000},
          [](auto& s) -> auto& { return s.battery.mean_s; }),
      real<S>(
          {.table = "battery",
           .key = "interval_s",
           .description = "Interval at which the battery is reported and logged.",
           .unit = kSeconds,
           .low = 0.1,
           .high = 3600},
          [](auto& s) -> auto& { return s.battery.interval_s; }),
  };
}

}  // namespace

std::vector<Option<Settings>> battery_options() {
  auto options = pack_options();
  auto load = load_options();
  options.insert(options.end(), std::make_move_iterator(load.begin()), std::make_move_iterator(load.end()));
  return options;
}

}  // namespace navcal::config
