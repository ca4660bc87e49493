// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "protocols/frame.h"

namespace navcal::ports {

/// Delivers bytes at the pace of a serial line: in pieces as a UART's FIFO hands them over, each at the time at
/// which its last byte has passed the wire. Deadlines are absolute, so a late timer delays one piece and nothing
/// after it.
class PacedWriter {
 public:
  using Put = std::function<void(std::int64_t now_ns, protocols::Bytes piece)>;
  /// The FIFO of a 16550A, the UART that everybody copied.
  static constexpr std::size_t kPieceBytes = 16;

  PacedWriter(const boost::asio::any_io_executor& executor, Put put);
  PacedWriter(const PacedWriter&) = delete;
  PacedWriter& operator=(const PacedWriter&) = delete;

  /// The first bit is on the wire at `start_ns` (monotonic), or when the bytes before it have passed. 8N1: ten
  /// bits to a byte.
  void send(std::int64_t start_ns, int baud, protocols::Bytes bytes);
  /// Discards the bytes that are still on their way.
  void clear();
  [[nodiscard]] bool idle() const { return pieces_.empty(); }

 private:
  struct Piece {
    std::int64_t due_ns;
    std::vector<std::uint8_t> bytes;
  };
  void wait();
  void put_due();

  boost::asio::steady_timer timer_;
  Put put_;
  std::deque<Piece> pieces_;
  std::int64_t line_free_ns_ = 0;
  std::shared_ptr<char> alive_ = std::make_shared<char>();  ///< an expiry already queued may come after the end
};

}  // namespace navcal::ports
