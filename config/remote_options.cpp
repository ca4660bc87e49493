// SPDX-License-Identifier: Apache-2.0
#include "config/network_address.h"
#include "config/options.h"
#include "config/text_rules.h"

namespace navcal::config {
namespace {

bool is_absolute_path_or_nothing(std::string_view text) { return text.empty() || is_absolute_path(text); }

bool is_socket_address_or_nothing(std::string_view text) { return text.empty() || socket_address(text); }

}  // namespace

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

}  // namespace navcal::config
