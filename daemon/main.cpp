// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <malloc.h>
#include <poll.h>
#include <spdlog/async.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/printable.h"
#include "config/load.h"
#include "daemon/check.h"
#include "daemon/daemon.h"
#include "daemon/motor_note.h"
#include "daemon/start_error.h"
#include "link/key.h"
#include "share/manual.h"

namespace {

namespace asio = boost::asio;
using navcal::daemon::Daemon;

enum Exit : int { kStopped = 0, kCannotStart = 1, kUsage = 2, kBadConfiguration = 3, kShaftMayTurn = 4 };
/// A start without a configuration tries for so long to bring the motor card into the safe state.
constexpr std::chrono::seconds kSafeState{20};

struct Options {
  std::string config;
  std::vector<std::string> overrides;
  bool check = false;
};

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
    write_all(navcal::base::printable({text.data(), text.size() - 1}) + '\n');
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

/// Writes messages to standard error in a thread of its own, so that a blocked journal, a stopped pager or a
/// busy disk does not block the loop. A message that cannot be written for a second is dropped and counted; the
/// count is reported as soon as the reader reads again. (Messages that overrun the queue of 128 within that
/// second are lost, oldest first, and not counted.)
class Diagnostics {
 public:
  Diagnostics() {
    spdlog::init_thread_pool(kMessages, 1);
    spdlog::set_default_logger(
        std::make_shared<spdlog::async_logger>("navcald", std::make_shared<StandardError>(), spdlog::thread_pool(),
                                               spdlog::async_overflow_policy::overrun_oldest));
    // journald adds the time itself and reads the priority from the first characters.
    spdlog::set_pattern(std::getenv("JOURNAL_STREAM") != nullptr ? "%v" : "%H:%M:%S.%e %l %v");
  }
  /// Writes what waits; that takes no longer than a reader who does not read may hold up one message.
  ~Diagnostics() { spdlog::shutdown(); }
  Diagnostics(const Diagnostics&) = delete;
  Diagnostics& operator=(const Diagnostics&) = delete;
};

/// The exit status when the command line has said it all: help, version, or a mistake.
std::optional<int> parse(int argc, char** argv, Options& options) {
  CLI::App app{"navcald: reads, stamps, logs and serves the instruments of a small underwater vehicle", "navcald"};
  app.set_version_flag("--version", "navcald " NAVCAL_VERSION);
  app.add_option("--config", options.config, "configuration file")->default_val("/etc/navcal/navcald.toml");
  app.add_option("--set", options.overrides, "a setting that overrides the file, KEY=VALUE; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_flag("--check", options.check, "only read the configuration and print what navcald would do");
  app.footer("Example: navcald --config navcald.toml --set port.compass.path=/dev/ttyUSB0 --check");
  navcal::share::add_manual(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kStopped : kUsage;
  }
  return std::nullopt;
}

/// SIGTERM and SIGINT stop, at once when they come twice; SIGHUP begins a new log file.
void wait_for_signal(asio::signal_set& signals, Daemon& daemon) {
  signals.async_wait([&signals, &daemon](boost::system::error_code error, int signal) {
    if (error) return;
    wait_for_signal(signals, daemon);
    if (signal == SIGHUP) return daemon.rotate_log();
    daemon.stop(signal == SIGTERM ? "SIGTERM" : "SIGINT", [&signals] { signals.cancel(); });
  });
}

/// Memory that was needed once is given back: one heap for all threads, which allocate little, and large blocks
/// outside of it. glibc would otherwise keep a heap for each thread, and raise the size of what counts as large.
void keep_memory_small() {
  constexpr int kLarge_bytes = 64 << 10;
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, kLarge_bytes);
  mallopt(M_TRIM_THRESHOLD, kLarge_bytes);
}

Exit run(const navcal::config::Settings& settings, const std::filesystem::path& note) {
  // One thread runs the context. Others (ControlServer's) hand their answers to it: its queue needs its lock.
  asio::io_context context(BOOST_ASIO_CONCURRENCY_HINT_UNSAFE_IO);
  // Signals are caught before the daemon can be reached, so that an early one does not kill it.
  asio::signal_set signals(context, SIGTERM, SIGINT, SIGHUP);
  Daemon daemon(context.get_executor(), settings, navcal::daemon::take_activated_sockets(context.get_executor()),
                note);
  wait_for_signal(signals, daemon);
  daemon.start();
  context.run();
  return daemon.finish() ? kStopped : kShaftMayTurn;
}

/// Throws config::Error.
void read_signing_keys(navcal::config::Settings& settings) {
  for (navcal::config::PortSettings& port : settings.ports) {
    if (port.signing_key_file.empty()) continue;
    try {
      port.signing_key = navcal::link::Key::from_file(port.signing_key_file).of_mavlink();
    } catch (const std::runtime_error& error) {
      throw navcal::config::Error({"port." + port.name + ".signing_key_file: " + error.what()});
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory_small();
  Options options;
  if (const auto status = parse(argc, argv, options)) return *status;
  try {
    auto settings = navcal::config::load(options.config, options.overrides);
    read_signing_keys(settings);
    if (options.check) {
      std::fputs(navcal::daemon::describe(settings).c_str(), stdout);
      return kStopped;
    }
    const Diagnostics diagnostics;
    return run(settings, navcal::daemon::second_note(options.config));
  } catch (const navcal::config::Error& error) {
    std::fprintf(stderr, "navcald: %s\n", error.what());
    if (options.check) return kBadConfiguration;
    const bool is_safe =
        navcal::daemon::order_safe_state_of(navcal::daemon::second_note(options.config), kSafeState);
    return is_safe ? kBadConfiguration : kShaftMayTurn;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navcald: cannot start: %s\n", navcal::base::printable(error).c_str());
    return kCannotStart;
  }
}
