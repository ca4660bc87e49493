// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

/// Linear equations with a symmetric matrix of any size, by LDL' with pivots. Eigen's template takes two seconds
/// to compile for each size; here it is compiled once.
namespace navcal::base {

/// X of A X = B; not all finite where A is singular.
[[nodiscard]] Eigen::MatrixXd solve_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                              const Eigen::Ref<const Eigen::MatrixXd>& b);

/// The inverse of A; not all finite where A is singular.
[[nodiscard]] Eigen::MatrixXd inverse_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& a);

}  // namespace navcal::base
