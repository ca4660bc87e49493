// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "protocols/frame.h"

namespace navcal::ports {

/// The device's side of a serial line: a pseudo-terminal under a chosen name, for play and emulate. Like a UART
/// it never waits for its reader: bytes without a listener or without room are lost and counted.
class PtyHost {
 public:
  /// Receives bytes that a client wrote, at `now_ns` (monotonic).
  using OnBytes = std::function<void(std::int64_t now_ns, protocols::Bytes bytes)>;

  /// Fate of the bytes written.
  struct Tally {
    std::uint64_t taken = 0;    ///< handed to the client that has the line open
    std::uint64_t unheard = 0;  ///< lost: no client had the line open
    std::uint64_t overrun = 0;  ///< lost: the client did not read
  };

  /// Makes the pseudo-terminal and the link to it (its folder too), replacing a link left behind. Throws
  /// std::system_error, or std::runtime_error when something other than a link has the name, or another PtyHost
  /// has it.
  PtyHost(const boost::asio::any_io_executor& executor, std::filesystem::path link, int baud, OnBytes on_bytes);
  ~PtyHost();  ///< hangs up and removes the link
  PtyHost(const PtyHost&) = delete;
  PtyHost& operator=(const PtyHost&) = delete;

  /// Writes at once, as far as there is a reader and room; returns how many bytes were taken.
  std::size_t write(protocols::Bytes bytes);
  /// Unplugs: clients see a hang-up, and the link is removed. replug() makes a new pseudo-terminal under the
  /// old name.
  void unplug();
  void replug();
  [[nodiscard]] bool plugged() const;
  /// Whether a client has the line open now.
  [[nodiscard]] bool has_client() const;
  /// Number of bytes that a client has not read yet; a hang-up would lose them.
  [[nodiscard]] std::size_t unread() const;
  /// Speed to which the client has set its end, until then that of the host; 0 when unplugged or not a usual
  /// speed.
  [[nodiscard]] int client_baud() const;
  [[nodiscard]] const Tally& tally() const;
  [[nodiscard]] const std::filesystem::path& link() const;
  /// The pseudo-terminal's own name, /dev/pts/N; empty while unplugged.
  [[nodiscard]] std::string device() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace navcal::ports
