// SPDX-License-Identifier: Apache-2.0
#include "config/log_choice.h"
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

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

}  // namespace navcal::config
