// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::ports {

/// Properties of an opened port.
struct OpenPort {
  std::string path;  ///< what was opened, links resolved; of a socket its address
  bool pseudo_terminal = false;
  bool is_network = false;  ///< a socket: no line speed of its own
  std::string low_latency;  ///< what was asked for and what was read back, in words
  std::string description;  ///< USB ids, driver, where known
};

/// Gets every event of one port, in order, on the I/O thread.
class PortListener {
 public:
  virtual ~PortListener() = default;
  virtual void on_opened(std::int64_t now_ns, const OpenPort& port) = 0;
  /// `arrival_ns`: monotonic, taken when the wait for bytes ended, before anything else was done with them.
  virtual void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) = 0;
  /// The bytes were handed to the driver.
  virtual void on_sent(std::int64_t now_ns, protocols::Bytes bytes) = 0;
  /// Bytes of send() that the driver did not get and will not get.
  virtual void on_dropped(protocols::Bytes /*bytes*/) {}
  /// The port is gone, or could not be opened; `reason` for people. Called once for each reason, not at every
  /// attempt.
  virtual void on_lost(std::int64_t now_ns, std::string_view reason) = 0;
};

/// One configured port for as long as the daemon runs. It is found by path, udev name, USB serial number or
/// network address, opened and read. A lost port is found again within a second, whatever its name. Reading waits
/// for nothing but bytes.
class Port {
 public:
  Port(const boost::asio::any_io_executor& executor, config::PortSettings settings, PortListener& listener);
  ~Port();
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  /// Listens from now on, before start(), for the device that connects. Empty, or why it cannot.
  [[nodiscard]] std::string listen();
  void start();
  /// Queues bytes for sending, at most 4 KiB. Bytes for which there is no room are dropped as a whole, as are all
  /// bytes while the port is away. To a UDP port each call sends one datagram: peers have room for a message or a
  /// few, and cut what is longer.
  void send(protocols::Bytes bytes);
  /// Writes a whole line at once: nothing waits before it, and the driver has taken all of it when this
  /// returns. Returns the time at which the driver had it. nullopt when the port is away, other bytes still
  /// wait, or there is no room for the whole line (its beginning may then have been taken). on_sent() is called
  /// within.
  [[nodiscard]] std::optional<std::int64_t> send_now(protocols::Bytes bytes);
  /// Waits at most `limit` until the bytes that the driver has taken are on the wire. Closing a serial port
  /// restores its former speed at once, even with bytes still on their way.
  void flush(std::chrono::milliseconds limit);
  /// Closes, restoring the tty's former settings; no callbacks afterwards.
  void stop();

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// CLOCK_MONOTONIC in nanoseconds: the one clock of the program.
[[nodiscard]] std::int64_t monotonic_ns();

}  // namespace navcal::ports
