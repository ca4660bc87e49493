// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace navcal::nav {

/// Radius of the circle about the mean that contains 95 % of a normal distribution in the plane with this
/// covariance. By the polynomial of Leenhouts ("On the computation of bi-normal radial error", Navigation 32,
/// 1985), to 0.5 %. Units of the square root of the covariance.
[[nodiscard]] double radius_95_m(const Eigen::Matrix2d& covariance_m2);

}  // namespace navcal::nav
