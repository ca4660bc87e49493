// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "gap/data/innovations.h"

namespace navcal::gap {

/// A time series that an unknown error may follow: (quantity - mean) / scale, one value for each interval of the
/// course. In its own course it has mean zero and a root mean square of 1.
struct Covariate {
  std::string name;                        ///< as people read it: "yaw_rate x speed"
  std::vector<std::string_view> families;  ///< kinds of quantities in it: "rate", "speed"
  std::string_view regime;                 ///< of the residual map (replay/regimes.h) that is nearest to it
  bool is_basic = false;                   ///< one of those by which sources are told apart
  bool varies = false;                     ///< enough in this course for anything to be said of it
  double mean = 0, scale = 1;              ///< of the quantity, SI
  Eigen::VectorXd values;
};

/// Quantities of a course, their derivatives, low-passes and squares, and products of two: the same list for each
/// course. The course is smoothed over a second, because a covariate must not contain the noise of the residuals
/// that it explains.
[[nodiscard]] std::vector<Covariate> covariates_of(const Trajectory10Hz& course);

}  // namespace navcal::gap
