// SPDX-License-Identifier: Apache-2.0
#include "daemon/diagnostics.h"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/async.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "base/printable.h"

namespace navcal::daemon {
namespace {

constexpr std::size_t kMessages = 128;
constexpr int kPatience_ms = 1000;

/// Standard error, which may be a file, a pipe, a terminal or journald's socket.
class StandardError final : public spdlog::sinks::base_sink<spdlog::details::null_mutex> {
 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (!is_ready(dropped_ > 0 ? 0 : kPatience_ms)) {
      ++dropped_;
      return;
    }
    if (dropped_ > 0) {
      write_all(fmt::format("{} messages were dropped: standard error was not read\n", dropped_));
      dropped_ = 0;
    }
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    // One line each, whatever is in it: nobody forges another in the journal.
    write_all(base::printable({text.data(), text.size() - 1}) + '\n');
  }
  void flush_() override {}

  /// A pipe or socket that says so takes a message without waiting; a file says so always.
  static bool is_ready(int patience_ms) {
    pollfd standard_error{STDERR_FILENO, POLLOUT, 0};
    return poll(&standard_error, 1, patience_ms) > 0 && (standard_error.revents & POLLOUT) != 0;
  }
  static void write_all(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return;  // nowhere to complain
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  std::size_t dropped_ = 0;
};

}  // namespace

Diagnostics::Diagnostics() {
  spdlog::init_thread_pool(kMessages, 1);
  spdlog::set_default_logger(
      std::make_shared<spdlog::async_logger>("navcald", std::make_shared<StandardError>(), spdlog::thread_pool(),
                                             spdlog::async_overflow_policy::overrun_oldest));
  // journald adds the time itself and reads the priority from the first characters.
  spdlog::set_pattern(std::getenv("JOURNAL_STREAM") != nullptr ? "%v" : "%H:%M:%S.%e %l %v");
}

Diagnostics::~Diagnostics() { spdlog::shutdown(); }

}  // namespace navcal::daemon
