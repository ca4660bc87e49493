// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/descriptor.h"
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

}  // namespace navcal::cli
