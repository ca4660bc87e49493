// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace navcal::autopilot {

/// The x within low and high that minimises |A x - b|^2 + eps^2 |x|^2, eps > 0: strictly convex, so it is unique.
/// Primal active-set method (Nocedal and Wright, Numerical Optimization, 2006, section 16.5): solve with the
/// variables that are free; go as far as the first limit and hold that variable there; free the one whose gradient
/// points inwards most; end when none does.
[[nodiscard]] Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double eps,
                                                    const Eigen::VectorXd& low, const Eigen::VectorXd& high);

}  // namespace navcal::autopilot
