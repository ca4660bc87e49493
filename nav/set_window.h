// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace navcal::nav {

/// The set as a DVL shows it: velocity over the bottom less velocity through the water, both north and east,
/// averaged over a second. What changes within that second lowers its weight: in turns and at changes of speed the
/// velocity through the water is known least. No memory is taken.
class SetWindow {
 public:
  struct Set {
    Eigen::Vector2d set_m_s = Eigen::Vector2d::Zero();
    double std_m_s = 0;  ///< each axis
  };
  /// `std_m_s` of the difference, each axis. Times increase. Returns the mean when a second is full.
  std::optional<Set> take(std::int64_t time_ns, const Eigen::Vector2d& bottom_m_s,
                          const Eigen::Vector2d& water_m_s, double std_m_s);

 private:
  std::int64_t first_ns_ = 0, newest_ns_ = 0;
  Eigen::Vector2d first_bottom_m_s_ = Eigen::Vector2d::Zero(), first_water_m_s_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum_m_s_ = Eigen::Vector2d::Zero();
  double variances_m2_s2_ = 0;
  int count_ = 0;
};

}  // namespace navcal::nav
