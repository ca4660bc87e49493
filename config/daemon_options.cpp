// SPDX-License-Identifier: Apache-2.0
#include "config/battery_options.h"
#include "config/calibration_options.h"
#include "config/command_options.h"
#include "config/instrument_options.h"
#include "config/log_choice.h"
#include "config/navigation_options.h"
#include "config/options.h"
#include "config/remote_options.h"
#include "config/role_options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

std::vector<Option<Settings>> make_daemon_options() {
  const NumberOf<Settings> of_log{"log"}, of_status{"status"}, of_environment{"environment"};
  std::vector<Option<Settings>> options{
      text<Settings>(
          {.table = "vehicle",
           .key = "id",
           .description = "Identifies the vehicle for its whole life, even on another computer, such as a hull "
                          "number; empty: not given.",
           .text_rule = "at most 64 of letters, digits, _, - and .",
           .text_holds = is_identifier_or_nothing},
          [](auto& s) -> auto& { return s.vehicle.id; }),
      text<Settings>(
          {.table = "vehicle",
           .key = "name",
           .description = "The vehicle's name for people, such as the one on its hull; empty: the id.",
           .text_rule = "at most 64 bytes without control characters",
           .text_holds = is_short_or_nothing},
          [](auto& s) -> auto& { return s.vehicle.name; }),

      text<Settings>(
          {.table = "log",
           .key = "directory",
           .description = "Folder of the log files; created if it is missing.",
           .text_rule = "an absolute path",
           .text_holds = is_absolute_path},
          [](auto& s) -> auto& { return s.log.directory; }),
      boolean<Settings>(
          {.table = "log", .key = "enabled", .description = "Whether a log is written at all."},
          [](auto& s) -> auto& { return s.log.enabled; }),
      of_log(
          "sync_interval_s", "Interval of syncs to the disk: a power cut loses at most the data of this time.",
          kSeconds, 0.01, 60, [](auto& s) -> auto& { return s.log.sync_interval_s; }),
      of_log(
          "rotate_MB", "Size at which a log file is finished and a new one begun.", kMegabytes, 0.1, 1e6,
          [](auto& s) -> auto& { return s.log.rotate_bytes; }),
      of_log(
          "rotate_age_h", "Age at which a log file is finished and a new one begun.", kHours, 0.001, 8760,
          [](auto& s) -> auto& { return s.log.rotate_age_s; }),
      of_log(
          "free_floor_MB",
          "Space kept free on the disk: below it the oldest logs are deleted where that is enough, never the "
          "newest of an earlier run.",
          kMegabytes, 0, 1e9, [](auto& s) -> auto& { return s.log.free_floor_bytes; }),
      of_log(
          "queue_MB", "Memory for records that wait for a stalled disk; further records are lost and counted.",
          kMegabytes, 0.1, 4096, [](auto& s) -> auto& { return s.log.queue_bytes; }),
      list<Settings>(
          {.table = "log",
           .key = "leave_out",
           .description = "What the log does not contain (docs/log-format.md).",
           .text_rule = "samples, navigation, health, calibration, commands, raw or raw.NAME of a port",
           .text_holds = is_log_choice},
          [](auto& s) -> auto& { return s.log.leave_out; }),

      text<Settings>(
          {.table = "status",
           .key = "address",
           .description = "Address of the status socket. Everyone who can reach it can read all data: choose the "
                          "network accordingly.",
           .text_rule = "an IPv4 or IPv6 address, or localhost",
           .text_holds = is_ip_address},
          [](auto& s) -> auto& { return s.status.address; }),
      integer<Settings>(
          {.table = "status",
           .key = "port",
           .description = "TCP port of the status socket; 0: any free port. 2947 is gpsd's.",
           .low = 0,
           .high = 65535},
          [](auto& s) -> auto& { return s.status.port; }),
      of_status(
          "client_queue_kB",
          "Memory for reports to one slow client; further reports are dropped, and the client receives their "
          "number.",
          kKilobytes, 4, 65536, [](auto& s) -> auto& { return s.status.client_queue_bytes; }),
      integer<Settings>(
          {.table = "status",
           .key = "max_clients",
           .description = "Maximum number of clients at once. A further one takes the place of one that watches "
                          "nothing, or is refused.",
           .low = 1,
           .high = 10000},
          [](auto& s) -> auto& { return s.status.max_clients; }),
      of_status(
          "health_interval_s",
          "Interval at which HEALTH is reported and logged; changes of state are reported at once.", kSeconds, 0.1,
          3600, [](auto& s) -> auto& { return s.status.health_interval_s; }),
      of_status(
          "nmea_heading_std_deg",
          "Largest standard error of the heading with which the NMEA sentence HDT is sent.", kDegrees, 0.01, 180,
          [](auto& s) -> auto& { return s.status.nmea_heading_std_rad; }),

      text<Settings>(
          {.table = "control",
           .key = "socket",
           .description = "Unix socket for commands; its file permissions determine who may send them.",
           .text_rule = "an absolute path of at most 107 bytes",
           .text_holds = is_socket_path},
          [](auto& s) -> auto& { return s.control.socket; }),
      integer<Settings>(
          {.table = "control",
           .key = "mode",
           .description = "File permissions of that socket.",
           .low = 0,
           .high = 0777,
           .octal = true},
          [](auto& s) -> auto& { return s.control.mode; }),

      boolean<Settings>(
          {.table = "environment",
           .key = "model",
           .description = "Whether declination, field and dip that are 0 here are computed from the World "
                          "Magnetic Model, from the first fix on."},
          [](auto& s) -> auto& { return s.environment.model; }),
      of_environment(
          "declination_deg", "Magnetic declination, positive when magnetic north lies east of true north.",
          kDegrees, -180, 180, [](auto& s) -> auto& { return s.environment.declination_rad; }),
      of_environment(
          "field_uT", "Magnitude of the Earth's field here; 0 if unknown.", kMicrotesla, 0, 100,
          [](auto& s) -> auto& { return s.environment.field_uT; }),
      of_environment(
          "dip_deg", "Inclination of the Earth's field, positive when it points down.", kDegrees, -90, 90,
          [](auto& s) -> auto& { return s.environment.dip_rad; }),
  };
  for (auto& option : role_options()) options.push_back(std::move(option));
  for (auto& option : instrument_options()) options.push_back(std::move(option));
  for (auto& option : calibration_options()) options.push_back(std::move(option));
  for (auto& option : navigation_options()) options.push_back(std::move(option));
  for (auto& option : command_options()) options.push_back(std::move(option));
  for (auto& option : battery_options()) options.push_back(std::move(option));
  for (auto& option : remote_options()) options.push_back(std::move(option));
  return options;
}

}  // namespace

const std::vector<Option<Settings>>& daemon_options() {
  static const std::vector<Option<Settings>> options = make_daemon_options();
  return options;
}

}  // namespace navcal::config
