// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "identify/parameters.h"

namespace navcal::identify {

/// Greatest standard error, as part of the prior's, of a number that the recordings tell.
inline constexpr double kTold = 0.5;

/// What the recordings do not tell: one parameter, or several of which they tell a combination only.
struct Direction {
  std::vector<std::size_t> parameters;
  std::string words;  ///< "body.mass_kg and added_mass.matrix.surge: only their sum"
};

/// A parameter is not told where its standard error is above kTold of the prior's. Those that are correlated by
/// more than 0.8 make one direction; told ones that are correlated with it by more than 0.95 are named with it.
/// The words say "sum" or "difference" where errors of the same unit are equally large, "ratio" or "product" where
/// relative errors are.
[[nodiscard]] std::vector<Direction> untold_directions(std::span<const Parameter> parameters,
                                                       const Eigen::VectorXd& values,
                                                       const Eigen::MatrixXd& covariance);

}  // namespace navcal::identify
