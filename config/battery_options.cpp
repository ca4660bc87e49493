// SPDX-License-Identifier: Apache-2.0
#include "config/options.h"

namespace navcal::config {

std::vector<Option<Settings>> battery_options() {
  const auto table = table_of<Settings>("battery", &Settings::battery);
  return {
      table.boolean("enabled", &BatterySettings::enabled,
                    "Whether the charge of the battery is counted, reported and watched."),
      table.number("capacity_Ah", &BatterySettings::capacity_Ah, kAmpereHours, 0.01, 10000,
                   "Charge that the full battery gives."),
      table.number("nominal_V", &BatterySettings::nominal_V, kVolts, 0.1, 1000,
                   "Nominal voltage, by which a charge is told as an energy."),
      table.channels("curve_V", &BatterySettings::curve_V, kVolts, 0, 1000,
                     "Open-circuit voltage at eight charges from empty to full, equally spaced. Eight zeros: not "
                     "known, and the voltage does not correct the charge."),
      table.number("voltage_error_V", &BatterySettings::voltage_error_V, kVolts, 0.001, 100,
                   "Error of that curve and of the voltage's gauge, one standard deviation."),
      table.number("resistance_ohm", &BatterySettings::resistance_ohm, kOhms, 0, 100,
                   "Internal resistance, which lowers the voltage under load."),
      table.number("rest_A", &BatterySettings::rest_A, kAmperes, 0, 1000,
                   "Current up to which the battery rests."),
      table.number("rest_s", &BatterySettings::rest_s, kSeconds, 0, 3600,
                   "The voltage corrects the charge after so long a rest."),
      table.number("hotel_A", &BatterySettings::hotel_A, kAmperes, 0, 1000,
                   "Current of everything but the motor. It is added to the motor's while no gauge measures the "
                   "whole current."),
      table.number("hotel_error_A", &BatterySettings::hotel_error_A, kAmperes, 0, 1000,
                   "Error of that current, one standard deviation."),
      table.number("current_error_percent", &BatterySettings::current_error, kPercent, 0, 100,
                   "Constant error of a measured current, one standard deviation."),
      table.number("low_percent", &BatterySettings::low, kPercent, 0, 100,
                   "The alarm battery_low is raised below this charge; 0: never."),
      table.number("low_V", &BatterySettings::low_V, kVolts, 0, 1000,
                   "It is also raised when the measured voltage stays below this for five seconds; 0: never."),
      table.number("mean_s", &BatterySettings::mean_s, kSeconds, 1, 36000,
                   "Time constant of the mean load and speed, from which time and range left follow."),
      table.number("interval_s", &BatterySettings::interval_s, kSeconds, 0.1, 3600,
                   "Interval at which the battery is reported and logged."),
  };
}

}  // namespace navcal::config
