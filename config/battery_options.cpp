// SPDX-License-Identifier: Apache-2.0
#include "config/battery_options.h"

#include <iterator>

namespace navcal::config {
namespace {

std::vector<Option<Settings>> pack_options() {
  using S = Settings;
  const NumberOf<S> number{"battery"};
  return {
      boolean<S>(
          {.table = "battery",
           .key = "enabled",
           .description = "Whether the charge of the battery is counted, reported and watched."},
          [](auto& s) -> auto& { return s.battery.enabled; }),
      number(
          "capacity_Ah", "Charge that the full battery gives.", kAmpereHours, 0.01, 10000,
          [](auto& s) -> auto& { return s.battery.capacity_Ah; }),
      number(
          "nominal_V", "Nominal voltage, by which a charge is told as an energy.", kVolts, 0.1, 1000,
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
      number(
          "voltage_error_V", "Error of that curve and of the voltage's gauge, one standard deviation.", kVolts,
          0.001, 100, [](auto& s) -> auto& { return s.battery.voltage_error_V; }),
      number(
          "resistance_ohm", "Internal resistance, which lowers the voltage under load.", kOhms, 0, 100,
          [](auto& s) -> auto& { return s.battery.resistance_ohm; }),
      number(
          "rest_A", "Current up to which the battery rests.", kAmperes, 0, 1000,
          [](auto& s) -> auto& { return s.battery.rest_A; }),
      number(
          "rest_s", "The voltage corrects the charge after so long a rest.", kSeconds, 0, 3600,
          [](auto& s) -> auto& { return s.battery.rest_s; }),
  };
}

std::vector<Option<Settings>> load_options() {
  using S = Settings;
  const NumberOf<S> number{"battery"};
  return {
      number(
          "hotel_A",
          "Current of everything but the motor. It is added to the motor's while no gauge measures the whole "
          "current.",
          kAmperes, 0, 1000, [](auto& s) -> auto& { return s.battery.hotel_A; }),
      number(
          "hotel_error_A", "Error of that current, one standard deviation.", kAmperes, 0, 1000,
          [](auto& s) -> auto& { return s.battery.hotel_error_A; }),
      number(
          "current_error_percent", "Constant error of a measured current, one standard deviation.", kPercent, 0,
          100, [](auto& s) -> auto& { return s.battery.current_error; }),
      number(
          "low_percent", "The alarm battery_low is raised below this charge; 0: never.", kPercent, 0, 100,
          [](auto& s) -> auto& { return s.battery.low; }),
      number(
          "low_V", "It is also raised when the measured voltage stays below this for five seconds; 0: never.",
          kVolts, 0, 1000, [](auto& s) -> auto& { return s.battery.low_V; }),
      number(
          "mean_s", "Time constant of the mean load and speed, from which time and range left follow.", kSeconds,
          1, 36000, [](auto& s) -> auto& { return s.battery.mean_s; }),
      number(
          "interval_s", "Interval at which the battery is reported and logged.", kSeconds, 0.1, 3600,
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
