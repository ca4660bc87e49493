// SPDX-License-Identifier: Apache-2.0
#include "nav/set_window.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace navcal::nav {
namespace {

constexpr double kWindow_s = 1;
/// Measurements that are further apart do not belong to one window.
constexpr double kWindowGap_s = 1.5;
/// The velocity through the water is off by this beside its constant share: waves, slip, fins.
constexpr double kWaterVelocityError_m_s = 0.05;
constexpr double kWindowChangeShare = 2;

}  // namespace

std::optional<SetWindow::Set> SetWindow::take(std::int64_t time_ns, const Eigen::Vector2d& bottom_m_s,
                                              const Eigen::Vector2d& water_m_s, double std_m_s) {
  if (count_ > 0 && base::seconds(time_ns - newest_ns_) > kWindowGap_s) count_ = 0;
  if (count_ == 0) {
    first_ns_ = time_ns;
    first_bottom_m_s_ = bottom_m_s;
    first_water_m_s_ = water_m_s;
    sum_m_s_.setZero();
    variances_m2_s2_ = 0;
  }
  newest_ns_ = time_ns;
  sum_m_s_ += bottom_m_s - water_m_s;
  variances_m2_s2_ += std_m_s * std_m_s;
  ++count_;
  if (base::seconds(time_ns - first_ns_) < kWindow_s) return std::nullopt;
  const double change_m_s =
      std::max((bottom_m_s - first_bottom_m_s_).norm(), (water_m_s - first_water_m_s_).norm());
  const double noise_m_s = std::sqrt(variances_m2_s2_) / count_;
  const Set set{sum_m_s_ / count_,
                std::hypot(noise_m_s, kWaterVelocityError_m_s, kWindowChangeShare * change_m_s)};
  count_ = 0;
  return set;
}

}  // namespace navcal::nav
