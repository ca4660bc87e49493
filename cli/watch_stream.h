// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::cli {

/// Request for the JSON reports that a daemon sends to everybody.
inline constexpr std::string_view kWatchAll = "?WATCH={\"enable\":true,\"json\":true};\n";

/// The status stream of a daemon, line by line; connects again by itself when the daemon has gone away.
class WatchStream {
 public:
  /// `request` is sent at each connection.
  WatchStream(std::string host, std::string port, std::string_view request = kWatchAll);
  ~WatchStream();
  WatchStream(const WatchStream&) = delete;
  WatchStream& operator=(const WatchStream&) = delete;

  /// The next line, without its newline; nullopt when `until` has come or a signal came in. Waits for both bytes
  /// and the daemon's return.
  std::optional<std::string> next(std::chrono::steady_clock::time_point until);
  [[nodiscard]] bool connected() const { return socket_ >= 0; }
  /// True when there was a connection at any time.
  [[nodiscard]] bool was_connected() const { return was_connected_; }
  /// Why it is not connected.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  std::optional<std::string> take_line();
  bool connect();
  void disconnect(std::string problem);

  std::string host_, port_, request_;
  int socket_ = -1;
  bool was_connected_ = false;
  std::string bytes_;
  std::string problem_;
  std::chrono::steady_clock::time_point next_attempt_{};
};

}  // namespace navcal::cli
