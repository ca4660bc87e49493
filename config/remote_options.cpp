// SPDX-License-Identifier: Apache-2.0
#include "config/remote_options.h"

#include "config/network_address.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

bool is_absolute_path_or_nothing(std::string_view text) { return text.empty() || is_absolute_path(text); }

bool is_socket_address_or_nothing(std::string_view text) { return text.empty() || socket_address(text); }

}  // namespace

std::vector<Option<Settings>> remote_options() {
  using S = Settings;
  return {
      text<S>(
          {.table = "remote",
           .key = "path",
           .description = "Serial port of the modem; also a pseudo-terminal.",
           .text_rule = "an absolute path, or nothing",
           .text_holds = is_absolute_path_or_nothing},
          [](auto& s) -> auto& { return s.remote.path; }),
      integer<S>(
          {.table = "remote", .key = "baud", .description = "Its speed.", .low = 300, .high = 4000000},
          [](auto& s) -> auto& { return s.remote.baud; }),
      text<S>(
          {.table = "remote",
           .key = "listen",
           .description =
               "TCP address instead of a serial port, for example \"127.0.0.1:2950\". One operator at a "
               "time.",
           .text_rule = "ADDRESS:PORT with an IP address, or nothing",
           .text_holds = is_socket_address_or_nothing},
          [](auto& s) -> auto& { return s.remote.listen; }),
      text<S>(
          {.table = "remote",
           .key = "key_file",
           .description = "File with the key that operator and vehicle share: 64 hexadecimal digits, or a text of "
                          "16 characters or more. Only its owner may have access to it.",
           .text_rule = "an absolute path, or nothing",
           .text_holds = is_absolute_path_or_nothing},
          [](auto& s) -> auto& { return s.remote.key_file; }),
      boolean<S>(
          {.table = "remote",
           .key = "orders_without_key",
           .description =
               "Whether everybody who reaches the link may steer the vehicle and change the daemon, when "
               "there is no key."},
          [](auto& s) -> auto& { return s.remote.orders_without_key; }),
      real<S>(
          {.table = "remote",
           .key = "budget_B_s",
           .description = "Bytes a second that the vehicle sends at most. The reports alone need 250.",
           .low = 300,
           .high = 1e6},
          [](auto& s) -> auto& { return s.remote.budget_B_s; }),
      real<S>(
          {.table = "remote",
           .key = "dead_s",
           .description = "The link is dead when the operator was not heard for this long.",
           .unit = kSeconds,
           .low = 2,
           .high = 3600},
          [](auto& s) -> auto& { return s.remote.dead_s; }),
      choice<S>(
          {.table = "remote",
           .key = "on_dead",
           .description =
               "What ends then, with the safe state: \"release\": a lease that was taken over the link; "
               "\"safe\": every lease, that of a controller on board too; \"nothing\": none, each ends "
               "by its own time-out.",
           .choices = {"release", "safe", "nothing"}},
          [](auto& s) -> auto& { return s.remote.on_dead; }),
  };
}

}  // namespace navcal::config
