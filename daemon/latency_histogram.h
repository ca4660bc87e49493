// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace navcal::daemon {

/// Histogram of the time from the arrival of bytes to the status socket, in powers of two of microseconds:
/// bucket 0 counts below 1 us, bucket k from 2^(k-1) to 2^k us, the last everything longer.
class LatencyHistogram {
 public:
  static constexpr std::size_t kBuckets = 21;  ///< the last begins at 0.5 s

  void add(std::int64_t latency_ns) {
    const auto us = static_cast<std::uint64_t>(latency_ns > 0 ? latency_ns : 0) / 1000;
    const auto bucket = static_cast<std::size_t>(std::bit_width(us));
    ++buckets_[bucket < kBuckets ? bucket : kBuckets - 1];
    sum_ns_ += latency_ns > 0 ? latency_ns : 0;
  }
  [[nodiscard]] const std::array<std::uint64_t, kBuckets>& buckets() const { return buckets_; }
  [[nodiscard]] std::int64_t sum_ns() const { return sum_ns_; }

 private:
  std::array<std::uint64_t, kBuckets> buckets_{};
  std::int64_t sum_ns_ = 0;
};

}  // namespace navcal::daemon
