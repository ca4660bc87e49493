// SPDX-License-Identifier: Apache-2.0
#include "base/service_manager.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace navcal::base {
namespace {

std::optional<std::uint64_t> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  const std::string_view digits(text);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

bool is_this_process(std::uint64_t pid) { return pid == static_cast<std::uint64_t>(getpid()); }

bool option_is(int descriptor, int option, int wanted) {
  int value = 0;
  socklen_t size = sizeof value;
  return getsockopt(descriptor, SOL_SOCKET, option, &value, &size) == 0 && value == wanted;
}

}  // namespace

void notify_manager(std::string_view state, IfBusy if_busy) {
  const char* path = std::getenv("NOTIFY_SOCKET");
  if (path == nullptr) return;
  const std::string_view name(path);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (name.size() < 2 || name.size() >= sizeof address.sun_path || (name[0] != '/' && name[0] != '@')) return;
  std::copy(name.begin(), name.end(), address.sun_path);
  if (name[0] == '@') address.sun_path[0] = '\0';  // an abstract socket
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return;
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  const int flags = MSG_NOSIGNAL | (if_busy == IfBusy::drop ? MSG_DONTWAIT : 0);
  (void)sendto(descriptor, state.data(), state.size(), flags, reinterpret_cast<const sockaddr*>(&address), length);
  close(descriptor);
}

std::chrono::microseconds watchdog_limit() {
  const auto limit_us = number_in("WATCHDOG_USEC");
  if (!limit_us) return {};
  if (std::getenv("WATCHDOG_PID") != nullptr) {
    const auto pid = number_in("WATCHDOG_PID");
    if (!pid || !is_this_process(*pid)) return {};
  }
  return std::chrono::microseconds(*limit_us);
}

int take_handed_over() {
  const auto pid = number_in("LISTEN_PID"), count = number_in("LISTEN_FDS");
  for (const char* variable : {"LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES"}) unsetenv(variable);
  constexpr std::uint64_t kMost = 1024;
  if (!pid || !is_this_process(*pid) || !count || *count > kMost) return 0;
  const int handed_over = static_cast<int>(*count);
  for (int fd = kFirstHandedOver; fd < kFirstHandedOver + handed_over; ++fd) (void)fcntl(fd, F_SETFD, FD_CLOEXEC);
  return handed_over;
}

bool is_listening(int descriptor, int family) {
  return option_is(descriptor, SO_DOMAIN, family) && option_is(descriptor, SO_TYPE, SOCK_STREAM) &&
         option_is(descriptor, SO_ACCEPTCONN, 1);
}

}  // namespace navcal::base
