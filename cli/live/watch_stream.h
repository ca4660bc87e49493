// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "cli/live/line_socket.h"

namespace navcal::cli {

/// Request for the JSON reports that a daemon sends to everybody.
inline constexpr std::string_view kWatchAll = "?WATCH={\"enable\":true,\"json\":true};\n";

/// Now and `seconds`; without any, never.
[[nodiscard]] inline std::chrono::steady_clock::time_point end_after(double seconds) {
  using Clock = std::chrono::steady_clock;
  if (seconds <= 0) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// The status stream of a daemon, line by line; connects again by itself when the daemon has gone away.
class WatchStream {
 public:
  /// `request` is sent at each connection.
  WatchStream(std::string host, std::string port, std::string_view request = kWatchAll);

  /// The next line, without its newline; nullopt when `until` has come or a signal came in. Waits for both bytes
  /// and the daemon's return.
  std::optional<std::string> next(std::chrono::steady_clock::time_point until);
  [[nodiscard]] bool connected() const { return socket_.has_value(); }
  /// True when there was a connection at any time.
  [[nodiscard]] bool was_connected() const { return was_connected_; }
  /// Why it is not connected.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  bool connect();
  void disconnect(std::string problem);

  std::string host_, port_, request_;
  std::optional<LineSocket> socket_;
  bool was_connected_ = false;
  std::string problem_;
  std::chrono::steady_clock::time_point next_attempt_{};
};

/// A stream that a thread reads ahead, so that a daemon need not leave anything out while its reader computes.
class ReadAhead {
 public:
  explicit ReadAhead(WatchStream stream);

  /// A line, or that the connection is another than before.
  struct Item {
    std::optional<std::string> line;
    bool is_connected = true;
    std::string problem;  ///< why it is not
  };
  /// nullopt when `until` has come.
  std::optional<Item> next(std::chrono::steady_clock::time_point until);

 private:
  void read(const std::stop_token& stop);

  WatchStream stream_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable_any changed_;
  std::deque<Item> items_;
  std::size_t waiting_bytes_ = 0;
  std::jthread reader_;
};

}  // namespace navcal::cli
