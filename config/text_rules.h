// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace navcal::config {

// Rules for the texts of a configuration. The wording of the messages stands in the option table.

/// Text is not empty and has no control characters.
[[nodiscard]] bool is_printable(std::string_view text);
/// Text is a path and not an address of another machine (tcp://...).
[[nodiscard]] bool is_local_path(std::string_view text);
[[nodiscard]] bool is_absolute_path(std::string_view text);
/// An absolute path that fits sockaddr_un.
[[nodiscard]] bool is_socket_path(std::string_view text);
/// IPv4 or IPv6, in numbers, or "localhost": any other name would make the start depend on a name server.
[[nodiscard]] bool is_ip_address(std::string_view text);
/// YYYY-MM-DD, a day of the calendar from 1980-01-06 (the first of GPS time) on.
[[nodiscard]] bool is_gps_date(std::string_view text);
/// 1 to 31 of a-z 0-9 _ -: it becomes part of log topics and file names.
[[nodiscard]] bool is_port_name(std::string_view text);
/// "gpiochip0", or its path in /dev.
[[nodiscard]] bool is_gpio_chip(std::string_view text);
[[nodiscard]] bool is_absolute_path_or_nothing(std::string_view text);
[[nodiscard]] bool is_port_name_or_nothing(std::string_view text);
/// At most 64 of letters, digits, '_', '-' and '.'.
[[nodiscard]] bool is_identifier_or_nothing(std::string_view text);
/// At most 64 bytes of printable text.
[[nodiscard]] bool is_short_or_nothing(std::string_view text);

}  // namespace navcal::config
