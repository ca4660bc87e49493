// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace navcal::daemon {

/// Reports waiting for a slow client: bounded, whole reports only. When it is full the newest is dropped and
/// counted.
class ClientQueue {
 public:
  explicit ClientQueue(std::size_t capacity_bytes) : capacity_(capacity_bytes) {}

  /// False when there was no room; the report is then counted as dropped.
  bool push(std::string_view report) {
    if (size() + report.size() > capacity_) {
      ++dropped_;
      return false;
    }
    append(report);
    return true;
  }

  /// The end of a report whose beginning is on the wire already: taken whatever its size, so that none is torn.
  void push_rest(std::string_view rest) { append(rest); }

  /// Bytes to be written next.
  [[nodiscard]] std::string_view front() const { return std::string_view(bytes_).substr(begin_); }

  void pop(std::size_t n) {
    begin_ += n;
    if (begin_ < bytes_.size()) return;
    bytes_.clear();
    begin_ = 0;
  }

  [[nodiscard]] bool empty() const { return begin_ == bytes_.size(); }
  [[nodiscard]] std::size_t size() const { return bytes_.size() - begin_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  /// Memory held, whatever is in it.
  [[nodiscard]] std::size_t allocated() const { return bytes_.capacity(); }

 private:
  void append(std::string_view report) {
    const std::size_t needed = size() + report.size();
    if (bytes_.size() + report.size() > bytes_.capacity()) {
      // Room already written is used again before more is taken, and no more is taken than the bound allows.
      bytes_.erase(0, begin_);
      begin_ = 0;
      if (needed > bytes_.capacity())
        bytes_.reserve(needed > capacity_ ? needed : std::min(2 * needed, capacity_));
    }
    bytes_ += report;
  }

  std::size_t capacity_;
  std::string bytes_;
  std::size_t begin_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace navcal::daemon
