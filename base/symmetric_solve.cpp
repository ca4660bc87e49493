// SPDX-License-Identifier: Apache-2.0
#include "base/symmetric_solve.h"

#include <Eigen/Cholesky>

namespace navcal::base {

Eigen::MatrixXd solve_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                const Eigen::Ref<const Eigen::MatrixXd>& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd inverse_symmetric(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  return a.ldlt().solve(Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

}  // namespace navcal::base
