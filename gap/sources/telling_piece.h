// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/inference/whitening.h"

namespace navcal::gap {

/// Begin of the piece of a mission in which whitened residuals have the largest power, s after the first interval.
/// `fix_times_s`: of the layout's fixes, s after the first interval. The residuals are as a Whitening returns
/// them.
[[nodiscard]] double loudest_piece_s(const Eigen::VectorXd& residual, const Layout& layout,
                                     const std::vector<double>& fix_times_s, double length_s);

}  // namespace navcal::gap
