// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "autopilot/autopilot.h"
#include "autopilot/pilot.h"
#include "cli/live/line_socket.h"

namespace navcal::cli {

/// A line of class STATE (docs/status-protocol.md).
struct StateLine {
  double time_s = 0;      ///< UTC, of validity
  bool magnetic = false;  ///< the heading is from magnetic north
  autopilot::Reading reading;
};

/// nullopt for a line of another class and for what is no JSON. A value of the wrong kind counts as unknown.
[[nodiscard]] std::optional<StateLine> parse_state(std::string_view line);

/// Connection of a pilot to a running navcald over its public sockets: the stream of its state, and a lease of
/// the motor card.
class PilotLink {
 public:
  using Clock = LineSocket::Clock;
  struct Address {
    std::string host = "127.0.0.1";
    int port = 2947;
    std::filesystem::path control = "/run/navcal/control";
  };
  /// Connects and asks for the state ten times a second. Throws std::runtime_error.
  explicit PilotLink(const Address& address);

  /// The newest STATE that has come, or the next; nullopt when none came by then. Throws std::runtime_error.
  [[nodiscard]] std::optional<StateLine> state(Clock::time_point until);

  struct Lease {
    int priority = 1;
    double timeout_s = 0.5;
  };
  /// Takes the lease. Throws std::runtime_error with the daemon's words when it is refused.
  void lease(const Lease& wanted);
  /// Why an order was not sent; nullopt: it was sent.
  [[nodiscard]] std::optional<std::string> order(const autopilot::Orders& orders, double state_time_s);
  /// Gives the lease back, if there is one and the daemon still hears.
  void release() noexcept;

 private:
  /// The daemon's answer, or why there is none.
  struct Answer {
    std::optional<std::string> refusal;
    std::string lease;
  };
  [[nodiscard]] Answer ask(const std::string& request);

  LineSocket status_;
  LineSocket control_;
  std::string lease_;
  std::chrono::milliseconds answer_limit_{400};  ///< time for which an answer is awaited; by the lease, if longer
};

}  // namespace navcal::cli
