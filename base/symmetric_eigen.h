// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

/// Eigenvalues of symmetric matrices of any size, computed by Eigen's solver for matrices of dynamic size. Its
/// template takes eight seconds to compile for each size; here it is compiled once.
namespace navcal::base {

struct SymmetricEigen {
  Eigen::VectorXd values;   ///< ascending; not all finite where the matrix is not
  Eigen::MatrixXd vectors;  ///< columns in the order of the values
};

[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& symmetric);

/// A v = value B v with B positive definite; vectors are scaled to v' B v = 1.
[[nodiscard]] SymmetricEigen generalized_symmetric_eigen(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                                         const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace navcal::base
