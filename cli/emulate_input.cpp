// SPDX-License-Identifier: Apache-2.0
#include "cli/emulate_input.h"

#include <unistd.h>

#include <array>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <chrono>
#include <string>

#include "ports/no_throw.h"

namespace navcal::cli {
namespace {

namespace asio = boost::asio;
constexpr std::size_t kLongestLine = 1024;

bool in_the_background(int fd) { return ::isatty(fd) != 0 && ::tcgetpgrp(fd) != ::getpgrp(); }

}  // namespace

asio::awaitable<void> read_lines(int fd, std::function<void(std::string_view)> on_line) {
  const auto executor = co_await asio::this_coro::executor;
  asio::steady_timer timer(executor);
  asio::posix::stream_descriptor input(executor);
  boost::system::error_code error;
  input.assign(::dup(fd), error);
  std::string held;
  while (!error) {
    const auto [failed] = co_await input.async_wait(asio::posix::stream_descriptor::wait_read, ports::kNoThrow);
    if (failed) break;
    if (in_the_background(fd)) {
      timer.expires_after(std::chrono::seconds(1));
      co_await timer.async_wait(ports::kNoThrow);
      continue;
    }
    // Read after the wait, not by Asio, which would make the shell's own descriptor non-blocking.
    std::array<char, 256> buffer{};
    const ssize_t n = ::read(input.native_handle(), buffer.data(), buffer.size());
    if (n <= 0) break;
    held.append(buffer.data(), static_cast<std::size_t>(n));
    for (auto end = held.find('\n'); end != std::string::npos; end = held.find('\n')) {
      on_line(std::string_view(held).substr(0, end));
      held.erase(0, end + 1);
    }
    if (held.size() > kLongestLine) held.clear();
  }
}

}  // namespace navcal::cli
