// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "config/load.h"
#include "daemon/check.h"
#include "daemon/daemon.h"
#include "daemon/diagnostics.h"
#include "daemon/motor_note.h"
#include "daemon/start_error.h"
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
  // One thread runs the context and all that belongs to it (the disk's thread knows none of it): no locks are
  // needed.
  asio::io_context context(BOOST_ASIO_CONCURRENCY_HINT_UNSAFE);
  // Signals are caught before the daemon can be reached, so that an early one does not kill it.
  asio::signal_set signals(context, SIGTERM, SIGINT, SIGHUP);
  Daemon daemon(context.get_executor(), settings, navcal::daemon::take_activated_sockets(context.get_executor()),
                note);
  wait_for_signal(signals, daemon);
  daemon.start();
  context.run();
  return daemon.finish() ? kStopped : kShaftMayTurn;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory_small();
  Options options;
  if (const auto status = parse(argc, argv, options)) return *status;
  try {
    const auto settings = navcal::config::load(options.config, options.overrides);
    if (options.check) {
      std::fputs(navcal::daemon::describe(settings).c_str(), stdout);
      return kStopped;
    }
    const navcal::daemon::Diagnostics diagnostics;
    return run(settings, navcal::daemon::second_note(options.config));
  } catch (const navcal::config::Error& error) {
    std::fprintf(stderr, "navcald: %s\n", error.what());
    if (options.check) return kBadConfiguration;
    const bool is_safe =
        navcal::daemon::order_safe_state_of(navcal::daemon::second_note(options.config), kSafeState);
    return is_safe ? kBadConfiguration : kShaftMayTurn;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "navcald: cannot start: %s\n", error.what());
    return kCannotStart;
  }
}
