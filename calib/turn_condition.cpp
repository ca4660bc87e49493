#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>

#include "calib/turn_filter.h"

namespace navcal::calib {

double TurnFilter::condition() const {
  // At most six: no allocation.
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  const TurnCovariance all = unscaled_covariance();
  int chosen[6] = {};
  int count = 0;
  for (int i = 0; i < 6; ++i) {
    if (prior_.sought[static_cast<std::size_t>(i)]) chosen[count++] = i;
  }
  if (count == 0) return 1;
  Matrix information(count, count);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) information(i, j) = all(chosen[i], chosen[j]);
  }
  information = Matrix(information.inverse());
  for (int i = 0; i < count; ++i) {
    const double believed = 1 / prior_.covariance(chosen[i], chosen[i]);
    information(i, i) -= believed;
    // Hardly more than was believed before, which is next to nothing.
    if (!(information(i, i) > believed)) return std::numeric_limits<double>::infinity();
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> unit = information.diagonal().cwiseSqrt().cwiseInverse();
  information = Matrix(unit.asDiagonal() * information * unit.asDiagonal());
  const auto eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(information, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(eigenvalues[0] > 0)) return std::numeric_limits<double>::infinity();
  return eigenvalues[count - 1] / eigenvalues[0];
}

}  // namespace navcal::calib
