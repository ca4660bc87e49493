// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace navcal::control {

/// At most so many a second, in bursts of up to a quarter of a second's: a token bucket.
class OrderRate {
 public:
  explicit OrderRate(double rate_Hz);

  /// False: one too many. What is refused costs no token, so a flood passes at the rate.
  [[nodiscard]] bool take(std::int64_t now_ns);
  /// As if nothing had come yet: somebody else begins.
  void refill() { tokens_ = burst_; }

 private:
  double rate_Hz_;
  double burst_;
  double tokens_;
  std::int64_t last_ns_ = INT64_MIN;
};

}  // namespace navcal::control
