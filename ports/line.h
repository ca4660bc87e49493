// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "ports/port.h"
#include "protocols/frame.h"

namespace navcal::ports {

/// An open, non-blocking way to a device: a tty, a TCP connection, or UDP datagrams.
class Line {
 public:
  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;

  /// The descriptor to wait on. It belongs to the line.
  [[nodiscard]] virtual int fd() const = 0;
  [[nodiscard]] virtual const OpenPort& info() const = 0;
  /// As read(2) and write(2): the number of bytes, or -1 and errno.
  [[nodiscard]] virtual ssize_t read(std::span<std::uint8_t> buffer) = 0;
  [[nodiscard]] virtual ssize_t write(protocols::Bytes bytes) = 0;
  /// What a read of zero bytes means: empty when the line goes on, else why it has ended.
  [[nodiscard]] virtual std::string ended() const = 0;
  /// Waits at most `limit` until what was written is on the wire.
  virtual void flush(std::chrono::milliseconds limit) const = 0;
};

}  // namespace navcal::ports
