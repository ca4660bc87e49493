// SPDX-License-Identifier: Apache-2.0
#include "config/log_choice.h"
#include "config/network_address.h"
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

std::vector<Option<Settings>> role_options() {
  const auto table = table_of<Settings>("roles", &Settings::roles);
  std::vector<Option<Settings>> options;
  for (const Role role : kRoles) {
    const auto at = static_cast<std::size_t>(role);
    options.push_back(table.text(
        name_of(role), [at](auto& roles) -> auto& { return roles.port_names.at(at); }, is_port_name_or_nothing,
        "a port's name, or nothing", description_of(role)));
  }
  return options;
}

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

bool is_socket_address_or_nothing(std::string_view text) { return text.empty() || socket_address(text); }

std::vector<Option<Settings>> remote_options() {
  const auto table = table_of<Settings>("remote", &Settings::remote);
  return {
      table.text("path", &RemoteSettings::path, is_absolute_path_or_nothing, "an absolute path, or nothing",
                 "Serial port of the modem; also a pseudo-terminal."),
      table.integer("baud", &RemoteSettings::baud, kNoUnit, 300, 4000000, "Its speed."),
      table.text("listen", &RemoteSettings::listen, is_socket_address_or_nothing,
                 "ADDRESS:PORT with an IP address, or nothing",
                 "TCP address instead of a serial port, for example \"127.0.0.1:2950\". One operator at a time."),
      table.text("key_file", &RemoteSettings::key_file, is_absolute_path_or_nothing,
                 "an absolute path, or nothing",
                 "File with the key that operator and vehicle share: 64 hexadecimal digits, or a text of 16 "
                 "characters or more. Only its owner may have access to it."),
      table.boolean("orders_without_key", &RemoteSettings::orders_without_key,
                    "Whether everybody who reaches the link may steer the vehicle and change the daemon, when "
                    "there is no key."),
      table.number("budget_B_s", &RemoteSettings::budget_B_s, kNoUnit, 300, 1e6,
                   "Bytes a second that the vehicle sends at most. The reports alone need 250."),
      table.number("dead_s", &RemoteSettings::dead_s, kSeconds, 2, 3600,
                   "The link is dead when the operator was not heard for this long."),
      table.choice(
          "on_dead", &RemoteSettings::on_dead, {"release", "safe", "nothing"},
          "What ends then, with the safe state: \"release\": a lease that was taken over the link; \"safe\": "
          "every lease, that of a controller on board too; \"nothing\": none, each ends by its own time-out."),
  };
}

std::vector<Option<Settings>> make_daemon_options() {
  const auto vehicle = table_of<Settings>("vehicle", &Settings::vehicle);
  const auto log = table_of<Settings>("log", &Settings::log);
  const auto status = table_of<Settings>("status", &Settings::status);
  const auto control = table_of<Settings>("control", &Settings::control);
  const auto environment = table_of<Settings>("environment", &Settings::environment);
  auto mode =
      control.integer("mode", &ControlSettings::mode, kNoUnit, 0, 0777, "File permissions of that socket.");
  mode.octal = true;
  std::vector<Option<Settings>> options{
      vehicle.text("id", &IdentitySettings::id, is_identifier_or_nothing,
                   "at most 64 of letters, digits, _, - and .",
                   "Identifies the vehicle for its whole life, even on another computer, such as a hull number; "
                   "empty: not given."),
      vehicle.text("name", &IdentitySettings::name, is_short_or_nothing,
                   "at most 64 bytes without control characters",
                   "The vehicle's name for people, such as the one on its hull; empty: the id."),

      log.text("directory", &LogSettings::directory, is_absolute_path, "an absolute path",
               "Folder of the log files; created if it is missing."),
      log.boolean("enabled", &LogSettings::enabled, "Whether a log is written at all."),
      log.number("sync_interval_s", &LogSettings::sync_interval_s, kSeconds, 0.01, 60,
                 "Interval of syncs to the disk: a power cut loses at most the data of this time."),
      log.number("rotate_MB", &LogSettings::rotate_bytes, kMegabytes, 0.1, 1e6,
                 "Size at which a log file is finished and a new one begun."),
      log.number("rotate_age_h", &LogSettings::rotate_age_s, kHours, 0.001, 8760,
                 "Age at which a log file is finished and a new one begun."),
      log.number("free_floor_MB", &LogSettings::free_floor_bytes, kMegabytes, 0, 1e9,
                 "Space kept free on the disk: below it the oldest logs are deleted where that is enough, never "
                 "the newest of an earlier run."),
      log.number("queue_MB", &LogSettings::queue_bytes, kMegabytes, 0.1, 4096,
                 "Memory for records that wait for a stalled disk; further records are lost and counted."),
      log.list("leave_out", &LogSettings::leave_out, is_log_choice,
               "samples, navigation, health, calibration, commands, raw or raw.NAME of a port",
               "What the log does not contain (docs/log-format.md)."),

      status.text("address", &StatusSettings::address, is_ip_address, "an IPv4 or IPv6 address, or localhost",
                  "Address of the status socket. Everyone who can reach it can read all data: choose the network "
                  "accordingly."),
      status.integer("port", &StatusSettings::port, kNoUnit, 0, 65535,
                     "TCP port of the status socket; 0: any free port. 2947 is gpsd's."),
      status.number("client_queue_kB", &StatusSettings::client_queue_bytes, kKilobytes, 4, 65536,
                    "Memory for reports to one slow client; further reports are dropped, and the client receives "
                    "their number."),
      status.integer("max_clients", &StatusSettings::max_clients, kNoUnit, 1, 10000,
                     "Maximum number of clients at once. A further one takes the place of one that watches "
                     "nothing, or is refused."),
      status.number("health_interval_s", &StatusSettings::health_interval_s, kSeconds, 0.1, 3600,
                    "Interval at which HEALTH is reported and logged; changes of state are reported at once."),
      status.number("nmea_heading_std_deg", &StatusSettings::nmea_heading_std_rad, kDegrees, 0.01, 180,
                    "Largest standard error of the heading with which the NMEA sentence HDT is sent."),

      control.text("socket", &ControlSettings::socket, is_socket_path, "an absolute path of at most 107 bytes",
                   "Unix socket for commands; its file permissions determine who may send them."),
      mode,

      environment.boolean("model", &EnvironmentSettings::model,
                          "Whether declination, field and dip that are 0 here are computed from the World "
                          "Magnetic Model, from the first fix on."),
      environment.number("declination_deg", &EnvironmentSettings::declination_rad, kDegrees, -180, 180,
                         "Magnetic declination, positive when magnetic north lies east of true north."),
      environment.number("field_uT", &EnvironmentSettings::field_uT, kMicrotesla, 0, 100,
                         "Magnitude of the Earth's field here; 0 if unknown."),
      environment.number("dip_deg", &EnvironmentSettings::dip_rad, kDegrees, -90, 90,
                         "Inclination of the Earth's field, positive when it points down."),
  };
  for (const auto& part : {role_options(), instrument_options(), calibration_options(), navigation_options(),
                           command_options(), battery_options(), remote_options()})
    options.insert(options.end(), part.begin(), part.end());
  return options;
}

}  // namespace

const std::vector<Option<Settings>>& daemon_options() {
  static const std::vector<Option<Settings>> options = make_daemon_options();
  return options;
}

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
