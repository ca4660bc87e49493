// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/descriptor.h"
#include "link/host.h"
#include "ports/line.h"
#include "protocols/frame.h"

namespace navcal::cli {

/// The operator's line to a vehicle: a serial port, or "tcp:HOST:PORT". It never blocks.
class RemoteConnection {
 public:
  /// Opens the line. Throws std::runtime_error with the reason.
  RemoteConnection(const std::string& address, int baud);

  [[nodiscard]] int fd() const { return tty_ ? tty_->fd() : socket_.get(); }
  /// What has come; nullopt: the line is lost.
  [[nodiscard]] std::optional<std::vector<std::uint8_t>> read();
  /// Drops the whole frame when the line takes nothing, as a radio does; false: the line is lost.
  bool send(protocols::Bytes frame);

 private:
  std::unique_ptr<ports::Line> tty_;
  base::Descriptor socket_;
};

/// An operator's program on the remote link: keeps the line open, the session alive, and the lease by repeating
/// the last order.
class RemoteOperator {
 public:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] static Clock::time_point after(double seconds);
  struct Options {
    std::string address;
    int baud = 57600;
    std::string key_file;
    double budget_B_s = 2000;
    int priority = 10;
    double lease_timeout_s = 5;
    std::string holder = "operator";
  };
  /// Opens the line. Throws std::runtime_error when the key or the line cannot be had.
  explicit RemoteOperator(const Options& options);

  /// Called for people: refusals, a line that is lost or back.
  std::function<void(std::string_view words)> on_notice = [](std::string_view) {};

  /// Works until something has come from the vehicle, `input` (a descriptor, or -1) can be read, a signal came, or
  /// `until`.
  void work(Clock::time_point until, int input = -1);
  /// Works until there is a session. Throws std::runtime_error with the reason when there is none by then.
  void wait_for_session(double limit_s);
  /// A request on the reliable stream and its answer. Throws std::runtime_error when none comes.
  [[nodiscard]] std::string ask(std::string_view line, double limit_s);

  void lease();
  /// The order is repeated until release() or the lease is lost. False: nobody has leased the motor.
  [[nodiscard]] bool order(double shaft_rpm, const std::array<double, 3>& fins_deg);
  /// The lease ends, and the vehicle orders its safe state.
  void release();
  /// Every lease ends, whoever holds it, and the vehicle orders its safe state.
  void stop();
  /// The lease is held, or asked for.
  [[nodiscard]] bool is_in_charge() const { return is_leasing_ || is_leased_; }
  /// Answer to the last lease, order, release or stop, for people; "ok", or why it was refused. Repeated orders
  /// answer only when they are refused.
  [[nodiscard]] std::optional<std::string> take_answer() { return std::exchange(answer_, std::nullopt); }

  /// Gives the lease back, if it is held, and ends the session, waiting for the vehicle's word a few seconds at
  /// most.
  void end();

  [[nodiscard]] link::Host& host() { return host_; }
  [[nodiscard]] bool is_alive() const { return host_.is_alive(now_ns()); }

 private:
  [[nodiscard]] static std::int64_t now_ns();
  void open_again();
  void pump();
  void give(link::Command command);
  void take_command_answer();
  void repeat_order();
  void watch_sessions();

  Options options_;
  link::Host host_;
  std::optional<RemoteConnection> connection_;
  std::int64_t open_again_ns_ = 0;
  std::optional<std::uint16_t> awaited_;  ///< number of the command whose answer is shown
  std::optional<std::string> answer_;
  bool is_leasing_ = false, is_leased_ = false;
  double shaft_rpm_ = 0;
  std::array<double, 3> fins_deg_{};
  std::int64_t order_due_ns_ = 0;
  unsigned sessions_ = 0;
  link::Refusal told_ = link::Refusal::none;
};

}  // namespace navcal::cli
