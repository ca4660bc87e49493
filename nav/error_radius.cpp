// SPDX-License-Identifier: Apache-2.0
#include "nav/error_radius.h"

#include <algorithm>
#include <cmath>

namespace navcal::nav {

double radius_95_m(const Eigen::Matrix2d& covariance_m2) {
  const double mean = covariance_m2.trace() / 2;
  const double half_difference = std::hypot((covariance_m2(0, 0) - covariance_m2(1, 1)) / 2, covariance_m2(0, 1));
  const double long_axis = std::sqrt(std::max(mean + half_difference, 0.0));
  if (long_axis == 0) return 0;
  const double share = std::sqrt(std::max(mean - half_difference, 0.0)) / long_axis;
  return long_axis * (1.960790 + share * (0.004071 + share * (0.114276 + share * 0.371625)));
}

}  // namespace navcal::nav
