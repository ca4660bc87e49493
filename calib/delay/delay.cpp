// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay.h"

#include <algorithm>

namespace navcal::calib {
namespace {

constexpr std::uint32_t kBlock = 100;  // readings: longer than what errs together
constexpr double kPriorBlocks = 5;
constexpr double kSettled_s = 0.02;  // standard deviation: before it the filter's other states settle
constexpr double kLeastDecrease =
    0.02;  // of the variance: a block with less information gives no measure of its error

}  // namespace

void DelayBlocks::update(double estimate, double variance) {
  if (in_block_ == 0) {
    estimate_ = estimate;
    variance_ = variance;
  }
  if (++in_block_ <= kBlock) return;
  in_block_ = 0;
  const double decrease = variance_ - variance;
  if (!(decrease > kLeastDecrease * variance_) || variance_ > kSettled_s * kSettled_s) return;
  square_ += (estimate - estimate_) * (estimate - estimate_) / decrease;
  ++blocks_;
}

double DelayBlocks::variance_scale(double noise_scale) const {
  return std::max(noise_scale, (kPriorBlocks * noise_scale + square_) / (kPriorBlocks + blocks_));
}

}  // namespace navcal::calib
