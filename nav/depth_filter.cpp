// SPDX-License-Identifier: Apache-2.0
#include "nav/depth_filter.h"

#include <algorithm>
#include <cmath>

namespace navcal::nav {
namespace {

/// After such a pause the next reading is taken as it is.
constexpr double kPause_s = 2;
constexpr double kMostRateError_m_s = 1;
/// Standard error of the rate between readings.
constexpr double kRateStd_m_s = 0.1;

}  // namespace

void DepthFilter::advance(double predicted_m_s, double duration_s) {
  since_s_ += duration_s;
  predicted_m_s_ = predicted_m_s;
  // How fast it sank before a pause says nothing of the time after it.
  if (since_s_ > kPause_s) rate_error_m_s_ = 0;
  if (depth_m_) *depth_m_ += sinking_m_s() * duration_s;
}

void DepthFilter::correct(double depth_m, std::optional<double> std_m) {
  if (!depth_m_ || since_s_ > kPause_s) {
    depth_m_ = depth_m;
  } else {
    const double difference_m = depth_m - *depth_m_;
    *depth_m_ -= difference_m * std::expm1(-options_.gain_per_s * since_s_);
    rate_error_m_s_ = std::clamp(rate_error_m_s_ + options_.rate_gain_per_s2 * since_s_ * difference_m,
                                 -kMostRateError_m_s, kMostRateError_m_s);
  }
  since_s_ = 0;
  reading_std_m_ = std_m;
}

std::optional<double> DepthFilter::std_m() const {
  if (!depth_m_ || !reading_std_m_) return std::nullopt;
  return std::hypot(*reading_std_m_, kRateStd_m_s * since_s_);
}

}  // namespace navcal::nav
