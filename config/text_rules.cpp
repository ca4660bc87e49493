// SPDX-License-Identifier: Apache-2.0
#include "config/text_rules.h"

#include <arpa/inet.h>
#include <sys/un.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <string>

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
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const auto number = [text](std::size_t first, std::size_t length) {
    int value = -1;
    const char* const end = text.data() + first + length;
    const auto result = std::from_chars(text.data() + first, end, value);
    return result.ptr == end ? value : -1;
  };
  using namespace std::chrono;
  const int month = number(5, 2);
  const int day = number(8, 2);
  if (month < 1 || day < 1) return false;
  const year_month_day date{year{number(0, 4)}, std::chrono::month{static_cast<unsigned>(month)},
                            std::chrono::day{static_cast<unsigned>(day)}};
  return date.ok() && sys_days{date} >= sys_days{year{1980} / January / 6};
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
