// SPDX-License-Identifier: Apache-2.0
#include "nav/held_velocity.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace navcal::nav {
namespace {

constexpr double kMostAcceleration_m_s2 = 1;
constexpr double kVelocityOutlierStds = 5;
constexpr int kAgreeingOutliers = 5;
/// Other instruments may be off by so much beyond what they state: the shaft of a vehicle in a hard turn.
constexpr double kExpectationSlack_m_s = 0.5;

constexpr double kWindow_s = 1;
/// Measurements that are further apart do not belong to one window.
constexpr double kWindowGap_s = 1.5;
/// The velocity through the water is off by this beside its constant share: waves, slip, fins.
constexpr double kWaterVelocityError_m_s = 0.05;
constexpr double kWindowChangeShare = 2;

}  // namespace

bool HeldVelocity::current(std::int64_t time_ns) const {
  return known_ && base::seconds(time_ns - newest_.time_ns) <= kPause_s;
}

bool HeldVelocity::follows(const Measurement& before, const Measurement& next) {
  const double change_m_s = (next.velocity_m_s - before.velocity_m_s).norm();
  return change_m_s <= kVelocityOutlierStds * std::hypot(before.std_m_s, next.std_m_s) +
                           kMostAcceleration_m_s2 * base::seconds(next.time_ns - before.time_ns);
}

bool HeldVelocity::is_outlier(const Measurement& next, const std::optional<Expected>& expected) const {
  if (current(next.time_ns)) return !follows(newest_, next);
  if (!expected) return false;
  const double off_m_s = (next.velocity_m_s - expected->velocity_m_s).head<2>().norm();
  return off_m_s > kVelocityOutlierStds * std::hypot(next.std_m_s, expected->std_m_s) + kExpectationSlack_m_s;
}

bool HeldVelocity::insists(const Measurement& outlier) {
  const bool agrees = outliers_in_a_row_ > 0 && follows(newest_outlier_, outlier);
  outliers_in_a_row_ = agrees ? outliers_in_a_row_ + 1 : 1;
  newest_outlier_ = outlier;
  return outliers_in_a_row_ >= kAgreeingOutliers;
}

std::optional<HeldVelocity::Step> HeldVelocity::take(std::int64_t time_ns, const Eigen::Vector3d& velocity_m_s,
                                                     VelocityFrame frame, double std_m_s,
                                                     const std::optional<Expected>& expected) {
  if (frame != frame_) {
    known_ = false;
    outliers_in_a_row_ = 0;
    frame_ = frame;
  }
  const Measurement next{time_ns, velocity_m_s, std_m_s};
  if (is_outlier(next, expected)) {
    if (!insists(next)) {
      ++outliers_;
      return std::nullopt;
    }
    known_ = false;
  }
  outliers_in_a_row_ = 0;
  Step step;
  if (current(time_ns)) {
    step.change_m_s = velocity_m_s - newest_.velocity_m_s;
    step.since_s = base::seconds(time_ns - newest_.time_ns);
    interval_s_ = step.since_s;
  }
  newest_ = next;
  known_ = true;
  return step;
}

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
