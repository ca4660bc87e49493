// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <memory>
#include <string>
#include <variant>

#include "base/descriptor.h"
#include "ports/finder.h"
#include "ports/low_latency.h"
#include "ports/port.h"

struct sp_port;

namespace navcal::ports {

/// A tty opened exclusively: raw 8N1 at a speed, non-blocking; its former settings are restored at the end.
/// libserialport opens and sets up real ttys (any speed, not only those of termios). It does not open
/// pseudo-terminals, so termios sets those up.
class Tty {
 public:
  /// Opens it. Returns the tty, or the reason why not, for people.
  static std::variant<Tty, std::string> open(const Found& found, int baud, bool low_latency);
  Tty(Tty&&) noexcept = default;
  Tty& operator=(Tty&&) = delete;
  ~Tty();

  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] const OpenPort& info() const { return info_; }
  /// Whether there is still a device behind the descriptor; asked after a read of zero bytes.
  [[nodiscard]] bool alive() const;

 private:
  struct CloseSerial {
    void operator()(sp_port* port) const;
  };

  Tty() = default;
  std::string open_serial(int baud, bool low_latency);
  std::string open_pseudo_terminal(int baud);

  base::Descriptor device_;  ///< holds the lock; for a pseudo-terminal it is read and written too
  std::unique_ptr<sp_port, CloseSerial> serial_;
  int fd_ = -1;
  termios former_{};
  LowLatency latency_;
  OpenPort info_;
};

}  // namespace navcal::ports
