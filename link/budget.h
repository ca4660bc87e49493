// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "link/frame.h"

namespace navcal::link {

/// Token bucket: within any time T it lets pass at most rate * T + kBurst + kDebt bytes. Urgent frames may go into
/// debt, so that an order never waits for reports that were sent before it.
class Budget {
 public:
  static constexpr double kBurst = 2.0 * kMaxFrame;
  static constexpr double kDebt = kMaxFrame;

  explicit Budget(double rate_B_s) : rate_B_s_(rate_B_s) {}

  [[nodiscard]] bool allows(std::int64_t now_ns, std::size_t bytes, bool is_urgent) {
    refill(now_ns);
    return tokens_ + (is_urgent ? kDebt : 0) >= static_cast<double>(bytes);
  }
  void spend(std::size_t bytes) { tokens_ -= static_cast<double>(bytes); }
  /// When as many bytes may pass, if nothing else does.
  [[nodiscard]] std::int64_t ready_ns(std::size_t bytes, bool is_urgent) const {
    const double missing = static_cast<double>(bytes) - tokens_ - (is_urgent ? kDebt : 0);
    return filled_ns_ + (missing <= 0 ? 0 : static_cast<std::int64_t>(std::ceil(missing / rate_B_s_ * 1e9)) + 1);
  }

 private:
  void refill(std::int64_t now_ns) {
    if (now_ns <= filled_ns_) return;
    tokens_ = std::min(kBurst, tokens_ + static_cast<double>(now_ns - filled_ns_) * 1e-9 * rate_B_s_);
    filled_ns_ = now_ns;
  }

  double rate_B_s_;
  double tokens_ = kBurst;
  std::int64_t filled_ns_ = 0;
};

}  // namespace navcal::link
