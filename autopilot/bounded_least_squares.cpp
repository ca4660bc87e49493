// SPDX-License-Identifier: Apache-2.0
#include "autopilot/bounded_least_squares.h"

#include <Eigen/Cholesky>
#include <vector>

namespace navcal::autopilot {
namespace {

enum class Held { no, at_low, at_high };

/// The step of the free variables to the minimum with the others where they are.
Eigen::VectorXd free_step(const Eigen::MatrixXd& H, const Eigen::VectorXd& gradient,
                          const std::vector<Held>& held) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    if (held[static_cast<std::size_t>(i)] == Held::no) free.push_back(i);
  }
  Eigen::VectorXd step = Eigen::VectorXd::Zero(H.rows());
  if (!free.empty()) {
    const Eigen::VectorXd reduced = Eigen::MatrixXd(H(free, free)).ldlt().solve(-gradient(free));
    step(free) = reduced;
  }
  return step;
}

}  // namespace

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double eps,
                                      const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  const Eigen::Index n = A.cols();
  if (n == 0) return {};
  const Eigen::MatrixXd H = A.transpose() * A + eps * eps * Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd c = A.transpose() * b;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n).cwiseMax(low).cwiseMin(high);
  std::vector<Held> held(static_cast<std::size_t>(n), Held::no);
  const double inwards = 1e-12 * (1 + c.cwiseAbs().maxCoeff());
  for (Eigen::Index round = 0; round < 10 * (n + 1); ++round) {
    const Eigen::VectorXd step = free_step(H, H * x - c, held);
    double part = 1;
    Eigen::Index blocking = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double room = step[i] > 0 ? high[i] - x[i] : low[i] - x[i];
      if (step[i] != 0 && room / step[i] < part) {
        part = room / step[i];
        blocking = i;
      }
    }
    x = (x + part * step).cwiseMax(low).cwiseMin(high);
    if (blocking >= 0) {
      held[static_cast<std::size_t>(blocking)] = step[blocking] > 0 ? Held::at_high : Held::at_low;
      x[blocking] = step[blocking] > 0 ? high[blocking] : low[blocking];
      continue;
    }
    const Eigen::VectorXd gradient = H * x - c;
    double worst = inwards;
    Eigen::Index freed = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Held where = held[static_cast<std::size_t>(i)];
      const double inward = where == Held::no ? 0 : where == Held::at_low ? -gradient[i] : gradient[i];
      if (inward > worst && low[i] < high[i]) {
        worst = inward;
        freed = i;
      }
    }
    if (freed < 0) break;
    held[static_cast<std::size_t>(freed)] = Held::no;
  }
  return x;
}

}  // namespace navcal::autopilot
