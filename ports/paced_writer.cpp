// SPDX-License-Identifier: Apache-2.0
#include "ports/paced_writer.h"

#include <algorithm>
#include <chrono>

#include "ports/port.h"

namespace navcal::ports {

PacedWriter::PacedWriter(const boost::asio::any_io_executor& executor, Put put)
    : timer_(executor), put_(std::move(put)) {}

void PacedWriter::send(std::int64_t start_ns, int baud, protocols::Bytes bytes) {
  const bool was_idle = idle();
  const std::int64_t start = std::max(start_ns, line_free_ns_);
  const auto passed_ns = [&](std::size_t n) {
    return start + static_cast<std::int64_t>(n) * 10'000'000'000 / baud;
  };
  for (std::size_t from = 0; from < bytes.size(); from += kPieceBytes) {
    const std::size_t to = std::min(from + kPieceBytes, bytes.size());
    const auto piece = bytes.subspan(from, to - from);
    pieces_.push_back({passed_ns(to), {piece.begin(), piece.end()}});
  }
  line_free_ns_ = passed_ns(bytes.size());
  if (was_idle && !idle()) wait();
}

void PacedWriter::clear() {
  pieces_.clear();
  line_free_ns_ = 0;
  timer_.cancel();
}

void PacedWriter::wait() {
  timer_.expires_at(std::chrono::steady_clock::time_point(std::chrono::nanoseconds(pieces_.front().due_ns)));
  timer_.async_wait([this, alive = std::weak_ptr(alive_)](const boost::system::error_code& error) {
    if (!error && !alive.expired()) put_due();
  });
}

void PacedWriter::put_due() {
  while (!pieces_.empty()) {
    const std::int64_t now = monotonic_ns();
    if (pieces_.front().due_ns > now) return wait();
    const Piece piece = std::move(pieces_.front());
    pieces_.pop_front();
    put_(now, piece.bytes);
  }
}

}  // namespace navcal::ports
