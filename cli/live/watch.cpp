// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "base/interruptible.h"
#include "cli/live/commands.h"
#include "cli/live/watch_stream.h"
#include "cli/live/watch_view.h"

namespace navcal::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kRefresh = std::chrono::milliseconds(200);
constexpr auto kLineInterval = std::chrono::seconds(1);

struct WatchCommandOptions {
  std::string host = "127.0.0.1";
  int port = 2947;
  bool json = false;
  double seconds = 0;
};

/// The terminal's other screen with the cursor hidden; what was there before comes back at the end.
class Screen {
 public:
  Screen() { put("\x1b[?1049h\x1b[?25l"); }
  ~Screen() { put("\x1b[?25h\x1b[?1049l"); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Drawn over the old picture line by line, so that nothing flickers.
  static void draw(const std::string& page) {
    std::string out = "\x1b[H";
    for (const char c : page) out += c == '\n' ? std::string("\x1b[K\n") : std::string(1, c);
    put(out + "\x1b[J");
  }

 private:
  static void put(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
  }
};

std::string title(const WatchCommandOptions& options, const WatchStream& stream) {
  std::string text = fmt::format("navcald at {} port {}", options.host, options.port);
  if (!stream.connected()) text += fmt::format(": not connected ({}), trying again", stream.problem());
  return text + "\n\n";
}

void pass_on(WatchStream& stream, Clock::time_point end) {
  while (!base::Interruptible::interrupted() && Clock::now() < end) {
    const auto line = stream.next(std::min(end, Clock::now() + kLineInterval));
    if (!line) continue;
    std::printf("%s\n", line->c_str());
    // Whoever reads a pipe wants to see it now.
    if (std::fflush(stdout) != 0) return;
  }
}

void show(const WatchCommandOptions& options, WatchStream& stream, Clock::time_point end, bool terminal) {
  const auto screen = terminal ? std::make_unique<Screen>() : nullptr;
  const auto interval = terminal ? Clock::duration(kRefresh) : Clock::duration(kLineInterval);
  WatchView view;
  auto next_picture = Clock::now() + interval;
  bool was_connected = false;
  while (!base::Interruptible::interrupted() && Clock::now() < end) {
    const auto line = stream.next(std::min(end, next_picture));
    if (was_connected && !stream.connected()) view.clear();
    was_connected = stream.connected();
    if (line) view.take(*line);
    if (Clock::now() < next_picture) continue;
    next_picture += interval;
    if (terminal) {
      Screen::draw(title(options, stream) + view.page(WatchView::Colour::ansi));
    } else {
      std::printf("%s\n",
                  stream.connected() ? view.line().c_str() : ("not connected: " + stream.problem()).c_str());
      if (std::fflush(stdout) != 0) return;
    }
  }
}

void watch(const WatchCommandOptions& options) {
  const base::Interruptible interruptible;
  // A reader that has gone is seen by fflush.
  std::signal(SIGPIPE, SIG_IGN);
  WatchStream stream(options.host, std::to_string(options.port));
  const auto end = end_after(options.seconds);
  if (options.json) {
    pass_on(stream, end);
  } else {
    show(options, stream, end, ::isatty(STDOUT_FILENO) != 0);
  }
  if (!stream.was_connected()) {
    throw base::Failure(
        base::Exit::failed,
        fmt::format("no connection to {} port {}: {}. Is navcald running there? Try navcal doctor.", options.host,
                    options.port, stream.problem()));
  }
}

}  // namespace

void add_watch(CLI::App& app) {
  const auto [command, options] =
      add_command<WatchCommandOptions>(app, "watch", "live view of a running navcald", watch);
  add_defaulted(command, "--host", options->host);
  add_number(command, "--port", 1, 65535, options->port);
  command->add_flag("--json", options->json);
  command->add_option("--seconds", options->seconds)->check(CLI::NonNegativeNumber);
}

}  // namespace navcal::cli
