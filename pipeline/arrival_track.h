// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace navcal::pipeline {

/// When which part of a byte stream arrived: the last reads of one port. A frame may be completed by a later read
/// than the one that brought its last byte (behind a truncated frame), so the parser's position alone is not
/// enough.
class ArrivalTrack {
 public:
  explicit ArrivalTrack(int baud) : byte_ns_(10'000'000'000LL / baud) {}

  void add(std::size_t bytes, std::int64_t arrival_ns) {
    end_offset_ += bytes;
    reads_[count_++ % kReads] = {end_offset_, arrival_ns};
  }

  struct Frame {
    std::int64_t arrival_ns = 0;  ///< of the read that brought its last byte
    std::int64_t start_ns = 0;    ///< latest time at which its first byte can have begun on the wire
    bool backlog = false;         ///< more followed in that read
  };
  /// Each read ends after the bytes it brought have passed the wire, so each gives a bound on the start; the
  /// earliest bound is the best. Ten bit times a byte (8N1).
  [[nodiscard]] Frame locate(std::uint64_t offset, std::uint64_t end) const;

  [[nodiscard]] std::uint64_t end_offset() const { return end_offset_; }
  [[nodiscard]] std::int64_t byte_ns() const { return byte_ns_; }

 private:
  struct Read {
    std::uint64_t end_offset = 0;
    std::int64_t arrival_ns = 0;
  };
  static constexpr std::size_t kReads = 512;  // more than the longest frame has bytes

  std::int64_t byte_ns_;
  std::uint64_t end_offset_ = 0;
  std::uint64_t count_ = 0;
  std::array<Read, kReads> reads_{};
};

}  // namespace navcal::pipeline
