// SPDX-License-Identifier: Apache-2.0
#include "config/text_rules.h"

#include <arpa/inet.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <string>

#include "protocols/utc.h"

namespace navcal::config {
namespace {

constexpr std::size_t kMaxIdentity = 64;

}  // namespace

bool is_printable(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(),
                                       [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

bool is_local_path(std::string_view text) {
  return is_printable(text) && text.find("://") == std::string_view::npos;
}

bool is_absolute_path(std::string_view text) { return is_printable(text) && text.front() == '/'; }
bool is_absolute_path_or_nothing(std::string_view text) { return text.empty() || is_absolute_path(text); }

bool is_socket_path(std::string_view text) {
  return is_absolute_path(text) && text.size() < sizeof(sockaddr_un::sun_path);
}

bool is_ip_address(std::string_view text) {
  if (!is_printable(text)) return false;
  if (text == "localhost") return true;
  std::array<unsigned char, sizeof(in6_addr)> address{};
  const std::string terminated(text);
  return inet_pton(AF_INET, terminated.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, terminated.c_str(), address.data()) == 1;
}

bool is_gps_date(std::string_view text) {
  const auto date = protocols::parse_iso_date(text);
  return date && *date >= protocols::Date{1980, 1, 6};
}

bool is_port_name(std::string_view text) {
  return !text.empty() && text.size() <= 31 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

bool is_gpio_chip(std::string_view text) {
  constexpr std::string_view kFolder = "/dev/", kName = "gpiochip";
  if (text.starts_with(kFolder)) text.remove_prefix(kFolder.size());
  if (!text.starts_with(kName)) return false;
  text.remove_prefix(kName.size());
  return !text.empty() && text.size() <= 4 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_port_name_or_nothing(std::string_view text) { return text.empty() || is_port_name(text); }

bool is_identifier_or_nothing(std::string_view text) {
  return text.size() <= kMaxIdentity && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                  c == '-' || c == '.';
         });
}

bool is_short_or_nothing(std::string_view text) {
  return text.empty() || (text.size() <= kMaxIdentity && is_printable(text));
}

}  // namespace navcal::config
