// SPDX-License-Identifier: Apache-2.0
#include "control/order_rate.h"

#include <algorithm>

namespace navcal::control {
namespace {

constexpr double kBurst_s = 0.25;

}  // namespace

OrderRate::OrderRate(double rate_Hz)
    : rate_Hz_(rate_Hz), burst_(std::max(2.0, rate_Hz * kBurst_s)), tokens_(burst_) {}

bool OrderRate::take(std::int64_t now_ns) {
  if (last_ns_ != INT64_MIN && now_ns > last_ns_)
    tokens_ = std::min(burst_, tokens_ + static_cast<double>(now_ns - last_ns_) * 1e-9 * rate_Hz_);
  last_ns_ = std::max(last_ns_, now_ns);
  if (tokens_ < 1) return false;
  tokens_ -= 1;
  return true;
}

}  // namespace navcal::control
