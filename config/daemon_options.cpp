// SPDX-License-Identifier: Apache-2.0
#include "config/calibration_options.h"
#include "config/command_options.h"
#include "config/navigation_options.h"
#include "config/options.h"
#include "config/role_options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

std::vector<Option<Settings>> make_daemon_options() {
  std::vector<Option<Settings>> options{
      text<Settings>(
          {.table = "log",
           .key = "directory",
           .description = "Folder of the log files; made when it is missing.",
           .text_rule = "an absolute path",
           .text_holds = is_absolute_path},
          [](auto& s) -> auto& { return s.log.directory; }),
      boolean<Settings>(
          {.table = "log", .key = "enabled", .description = "Whether a log is written at all."},
          [](auto& s) -> auto& { return s.log.enabled; }),
      real<Settings>(
          {.table = "log",
           .key = "sync_interval_s",
           .description = "How often what was written is brought to the disk: what a power cut can cost.",
           .unit = kSeconds,
           .low = 0.01,
           .high = 60},
          [](auto& s) -> auto& { return s.log.sync_interval_s; }),
      real<Settings>(
          {.table = "log",
           .key = "rotate_MB",
           .description = "A log file that has grown to this is finished, and a new one begun.",
           .unit = kMegabytes,
           .low = 0.1,
           .high = 1e6},
          [](auto& s) -> auto& { return s.log.rotate_bytes; }),
      real<Settings>(
          {.table = "log",
           .key = "rotate_age_h",
           .description = "Likewise a log file of this age.",
           .unit = kHours,
           .low = 0.001,
           .high = 8760},
          [](auto& s) -> auto& { return s.log.rotate_age_s; }),
      real<Settings>(
          {.table = "log",
           .key = "free_floor_MB",
           .description = "Space kept free on the disk: below it the oldest finished log file is deleted.",
           .unit = kMegabytes,
           .low = 0,
           .high = 1e9},
          [](auto& s) -> auto& { return s.log.free_floor_bytes; }),
      real<Settings>(
          {.table = "log",
           .key = "queue_MB",
           .description = "What may wait in memory for a stalled disk before records are lost (and counted).",
           .unit = kMegabytes,
           .low = 0.1,
           .high = 4096},
          [](auto& s) -> auto& { return s.log.queue_bytes; }),

      text<Settings>(
          {.table = "status",
           .key = "address",
           .description =
               "Address of the status socket. Whoever reaches it can read everything: mind the network.",
           .text_rule = "an IPv4 or IPv6 address, or localhost",
           .text_holds = is_ip_address},
          [](auto& s) -> auto& { return s.status.address; }),
      integer<Settings>(
          {.table = "status",
           .key = "port",
           .description = "TCP port of the status socket; 0 takes a free one. 2947 is gpsd's own.",
           .low = 0,
           .high = 65535},
          [](auto& s) -> auto& { return s.status.port; }),
      real<Settings>(
          {.table = "status",
           .key = "client_queue_kB",
           .description = "What may wait for one slow client before it misses reports (and is told how many).",
           .unit = kKilobytes,
           .low = 4,
           .high = 65536},
          [](auto& s) -> auto& { return s.status.client_queue_bytes; }),
      integer<Settings>(
          {.table = "status",
           .key = "max_clients",
           .description = "Clients served at once; further ones are turned away.",
           .low = 1,
           .high = 10000},
          [](auto& s) -> auto& { return s.status.max_clients; }),
      real<Settings>(
          {.table = "status",
           .key = "health_interval_s",
           .description = "How often HEALTH is reported and logged; changes of state are reported at once.",
           .unit = kSeconds,
           .low = 0.1,
           .high = 3600},
          [](auto& s) -> auto& { return s.status.health_interval_s; }),

      text<Settings>(
          {.table = "control",
           .key = "socket",
           .description = "Unix socket that takes commands; its permissions decide who may give them.",
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
           .description = "Whether declination, field and dip that are 0 here follow from the World Magnetic "
                          "Model, from the first fix on."},
          [](auto& s) -> auto& { return s.environment.model; }),
      real<Settings>(
          {.table = "environment",
           .key = "declination_deg",
           .description = "Magnetic declination, positive when magnetic north lies east of true north.",
           .unit = kDegrees,
           .low = -180,
           .high = 180},
          [](auto& s) -> auto& { return s.environment.declination_rad; }),
      real<Settings>(
          {.table = "environment",
           .key = "field_uT",
           .description = "Magnitude of the Earth's field here; 0 when not known.",
           .unit = kMicrotesla,
           .low = 0,
           .high = 100},
          [](auto& s) -> auto& { return s.environment.field_uT; }),
      real<Settings>(
          {.table = "environment",
           .key = "dip_deg",
           .description = "Inclination of the Earth's field, positive when it points down.",
           .unit = kDegrees,
           .low = -90,
           .high = 90},
          [](auto& s) -> auto& { return s.environment.dip_rad; }),
  };
  for (auto& option : role_options()) options.push_back(std::move(option));
  for (auto& option : calibration_options()) options.push_back(std::move(option));
  for (auto& option : navigation_options()) options.push_back(std::move(option));
  for (auto& option : command_options()) options.push_back(std::move(option));
  return options;
}

}  // namespace

const std::vector<Option<Settings>>& daemon_options() {
  static const std::vector<Option<Settings>> options = make_daemon_options();
  return options;
}

}  // namespace navcal::config
