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
        "a port's name, or nothing"));
  }
  return options;
}

std::vector<Option<Settings>> command_options() {
  const auto table = table_of<Settings>("command", &Settings::command);
  return {
      table.boolean("enabled", &CommandSettings::enabled),
      table.number("max_rpm", &CommandSettings::max_rpm, kCardRpm, 0, 100000),
      table.number("max_fin_deg", &CommandSettings::max_fin_deg, kCardDegrees, 0, 25),
      table.number("slew_rpm_s", &CommandSettings::slew_rpm_s, kCardRpmPerSecond, 0, 1e6),
      table.number("slew_fin_deg_s", &CommandSettings::slew_fin_deg_s, kCardDegreesPerSecond, 0, 1e4),
      table.number("min_timeout_s", &CommandSettings::min_timeout_s, kSeconds, 0.05, 60),
      table.number("max_timeout_s", &CommandSettings::max_timeout_s, kSeconds, 0.05, 3600),
      table.number("max_orders_Hz", &CommandSettings::max_orders_Hz, kHertz, 1, 200),
      table.number("echo_timeout_s", &CommandSettings::echo_timeout_s, kSeconds, 0, 5),
      table.number("safe_rpm", &CommandSettings::safe_rpm, kCardRpm, -100000, 100000),
      table.channels("safe_fins_deg", &CommandSettings::safe_fins_deg, kCardDegrees, -25, 25),
      table.choice("on_leak", &CommandSettings::on_leak, {"alarm", "safe"}),
      table.integer("operator_priority", &CommandSettings::operator_priority, kNoUnit, 0, 1001),
  };
}

std::vector<Option<Settings>> battery_options() {
  const auto table = table_of<Settings>("battery", &Settings::battery);
  return {
      table.boolean("enabled", &BatterySettings::enabled),
      table.number("capacity_Ah", &BatterySettings::capacity_Ah, kAmpereHours, 0.01, 10000),
      table.number("nominal_V", &BatterySettings::nominal_V, kVolts, 0.1, 1000),
      table.channels("curve_V", &BatterySettings::curve_V, kVolts, 0, 1000),
      table.number("voltage_error_V", &BatterySettings::voltage_error_V, kVolts, 0.001, 100),
      table.number("resistance_ohm", &BatterySettings::resistance_ohm, kOhms, 0, 100),
      table.number("rest_A", &BatterySettings::rest_A, kAmperes, 0, 1000),
      table.number("rest_s", &BatterySettings::rest_s, kSeconds, 0, 3600),
      table.number("hotel_A", &BatterySettings::hotel_A, kAmperes, 0, 1000),
      table.number("hotel_error_A", &BatterySettings::hotel_error_A, kAmperes, 0, 1000),
      table.number("current_error_percent", &BatterySettings::current_error, kPercent, 0, 100),
      table.number("low_percent", &BatterySettings::low, kPercent, 0, 100),
      table.number("low_V", &BatterySettings::low_V, kVolts, 0, 1000),
      table.number("mean_s", &BatterySettings::mean_s, kSeconds, 1, 36000),
      table.number("interval_s", &BatterySettings::interval_s, kSeconds, 0.1, 3600),
  };
}

bool is_socket_address_or_nothing(std::string_view text) { return text.empty() || socket_address(text); }

std::vector<Option<Settings>> remote_options() {
  const auto table = table_of<Settings>("remote", &Settings::remote);
  return {
      table.text("path", &RemoteSettings::path, is_absolute_path_or_nothing, "an absolute path, or nothing"),
      table.integer("baud", &RemoteSettings::baud, kNoUnit, 300, 4000000),
      table.text("listen", &RemoteSettings::listen, is_socket_address_or_nothing,
                 "ADDRESS:PORT with an IP address, or nothing"),
      table.text("key_file", &RemoteSettings::key_file, is_absolute_path_or_nothing,
                 "an absolute path, or nothing"),
      table.boolean("orders_without_key", &RemoteSettings::orders_without_key),
      table.number("budget_B_s", &RemoteSettings::budget_B_s, kNoUnit, 300, 1e6),
      table.number("dead_s", &RemoteSettings::dead_s, kSeconds, 2, 3600),
      table.choice("on_dead", &RemoteSettings::on_dead, {"release", "safe", "nothing"}),
  };
}

std::vector<Option<Settings>> make_daemon_options() {
  const auto vehicle = table_of<Settings>("vehicle", &Settings::vehicle);
  const auto log = table_of<Settings>("log", &Settings::log);
  const auto status = table_of<Settings>("status", &Settings::status);
  const auto control = table_of<Settings>("control", &Settings::control);
  const auto environment = table_of<Settings>("environment", &Settings::environment);
  auto mode = control.integer("mode", &ControlSettings::mode, kNoUnit, 0, 0777);
  mode.octal = true;
  std::vector<Option<Settings>> options{
      vehicle.text("id", &IdentitySettings::id, is_identifier_or_nothing,
                   "at most 64 of letters, digits, _, - and ."),
      vehicle.text("name", &IdentitySettings::name, is_short_or_nothing,
                   "at most 64 bytes without control characters"),

      log.text("directory", &LogSettings::directory, is_absolute_path, "an absolute path"),
      log.boolean("enabled", &LogSettings::enabled),
      log.number("sync_interval_s", &LogSettings::sync_interval_s, kSeconds, 0.01, 60),
      log.number("rotate_MB", &LogSettings::rotate_bytes, kMegabytes, 0.1, 1e6),
      log.number("rotate_age_h", &LogSettings::rotate_age_s, kHours, 0.001, 8760),
      log.number("free_floor_MB", &LogSettings::free_floor_bytes, kMegabytes, 0, 1e9),
      log.number("queue_MB", &LogSettings::queue_bytes, kMegabytes, 0.1, 4096),
      log.list("leave_out", &LogSettings::leave_out, is_log_choice,
               "samples, navigation, health, calibration, commands, raw or raw.NAME of a port"),

      status.text("address", &StatusSettings::address, is_ip_address, "an IPv4 or IPv6 address, or localhost"),
      status.integer("port", &StatusSettings::port, kNoUnit, 0, 65535),
      status.number("client_queue_kB", &StatusSettings::client_queue_bytes, kKilobytes, 4, 65536),
      status.integer("max_clients", &StatusSettings::max_clients, kNoUnit, 1, 10000),
      status.number("health_interval_s", &StatusSettings::health_interval_s, kSeconds, 0.1, 3600),
      status.number("nmea_heading_std_deg", &StatusSettings::nmea_heading_std_rad, kDegrees, 0.01, 180),

      control.text("socket", &ControlSettings::socket, is_socket_path, "an absolute path of at most 107 bytes"),
      mode,

      environment.boolean("model", &EnvironmentSettings::model),
      environment.number("declination_deg", &EnvironmentSettings::declination_rad, kDegrees, -180, 180),
      environment.number("field_uT", &EnvironmentSettings::field_uT, kMicrotesla, 0, 100),
      environment.number("dip_deg", &EnvironmentSettings::dip_rad, kDegrees, -90, 90),
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
      table.text("gpio_chip", &PowerSettings::gpio_chip, is_gpio_chip, "gpiochip0, or its path in /dev"),
      table.integer("line", &PowerSettings::line, kNoUnit, 0, 1023),
      table.list("devices", &PowerSettings::devices, is_port_name, "the name of a port"),
      table.boolean("active_low", &PowerSettings::active_low),
      table.choice("at_start", &PowerSettings::at_start, {"on", "off", "leave"}),
      table.number("settle_s", &PowerSettings::settle_s, kSeconds, 0, 600),
  };
  return options;
}

}  // namespace navcal::config
