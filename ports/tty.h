// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "base/descriptor.h"
#include "ports/finder.h"
#include "ports/line.h"

struct sp_port;

namespace navcal::ports {

/// Measures that were taken for a port's latency, as text, and the state to restore.
struct LowLatency {
  std::string report;
  std::optional<int> former_flags;  ///< of the driver, to be given back by the end
};

/// A tty opened exclusively: raw 8N1 at a speed, non-blocking; its former settings are restored at the end.
/// libserialport opens and sets up real ttys (any speed, not only those of termios). It does not open
/// pseudo-terminals, so termios sets those up.
class Tty final : public Line {
 public:
  /// Opens it. Returns the tty, or the reason why not, for people.
  static std::variant<std::unique_ptr<Line>, std::string> open(const Found& found, int baud, bool low_latency);
  ~Tty() override;

  [[nodiscard]] int fd() const override { return fd_; }
  [[nodiscard]] const OpenPort& info() const override { return info_; }
  [[nodiscard]] ssize_t read(std::span<std::uint8_t> buffer) override;
  [[nodiscard]] ssize_t write(protocols::Bytes bytes) override;
  [[nodiscard]] std::string ended() const override;
  void flush(std::chrono::milliseconds limit) const override;

 private:
  struct CloseSerial {
    void operator()(sp_port* port) const;
  };

  explicit Tty(int baud) : baud_(baud) {}
  std::string open_serial(bool low_latency);
  std::string open_pseudo_terminal();

  const int baud_;
  base::Descriptor device_;  ///< holds the lock; for a pseudo-terminal it is read and written too
  std::unique_ptr<sp_port, CloseSerial> serial_;
  int fd_ = -1;
  termios former_{};
  LowLatency latency_;
  OpenPort info_;
};

}  // namespace navcal::ports
