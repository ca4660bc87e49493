// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace navcal::control {

/// Token bucket that limits orders per second, with bursts of up to a quarter of a second's orders.
class OrderRate {
 public:
  explicit OrderRate(double rate_Hz);

  /// Returns false when the order exceeds the rate. A refused order costs no token, so a flood passes at the
  /// rate.
  [[nodiscard]] bool take(std::int64_t now_ns);
  /// Fills the bucket, as at the start; called when the holder changes.
  void refill() { tokens_ = burst_; }

 private:
  double rate_Hz_;
  double burst_;
  double tokens_;
  std::int64_t last_ns_ = INT64_MIN;
};

}  // namespace navcal::control
