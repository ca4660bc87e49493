// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/thesis/measured_path.h"
#include "calib/turn/turn_filter.h"
#include "calib/turn/turn_step.h"

/// The three problems of turns on one of the reference paths: what our filter finds, and what could be found.
namespace navcal::calib::thesis {

/// The filter before any reading, told the thesis's own noise.
[[nodiscard]] TurnFilter turn_filter(const TurnPrior& prior);
/// The turn between readings, in their order; the first steps belong to the first readings.
[[nodiscard]] std::vector<TurnStep> turn_steps(std::span<const Measured> readings);
/// The filter after all of these readings, told the thesis's own noise.
[[nodiscard]] TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior);

enum class TurnProblem {
  gyro,     ///< the compass has no error (THESIS 11.1)
  compass,  ///< the gyro is known (11.2)
  both      ///< neither (11.3)
};

/// Coefficients that a problem estimates, as indices of TurnCoefficient.
[[nodiscard]] std::vector<int> sought(TurnProblem problem);
/// True coefficients on the reference paths.
[[nodiscard]] TurnCoefficients true_coefficients(TurnProblem problem);
/// Readings of the problem's compass and gyro along a path.
[[nodiscard]] std::vector<Measured> measure(TurnProblem problem, const std::vector<TruePoint>& path,
                                            const Noise& noise, Random& random);
/// Our filter after the readings; its configured noise is the thesis's.
[[nodiscard]] TurnFilter filtered(TurnProblem problem, std::span<const Measured> readings);

/// Cramer-Rao bound on the standard deviation of the coefficients sought, in their order.
///
/// Model: psi_m(n) = T(n) + psi0 + scale S1(n) + bias S2(n) + f4(psi_m(n))'q + e(n), with the true regressors. The
/// rates along the path are unknown, too, and known by the readings of the gyro only: eliminating them leaves the
/// covariance V = diag(sigma_psi^2 (1 - E')^2) + scale^2 sigma_g^2 W, where W is that of the trapezoid sums of
/// white noise; the bound is the inverse of X'V^-1 X, less the row and column of psi0. Noise of the tilt is left
/// out.
[[nodiscard]] Eigen::VectorXd cramer_rao(TurnProblem problem, const std::vector<TruePoint>& path,
                                         const Noise& noise);

/// Error of a deviation curve over the whole circle, degrees.
struct CurveError {
  double largest_deg = 0;
  double deviation_deg = 0;  ///< standard deviation
};
[[nodiscard]] CurveError curve_error(const Eigen::Vector4d& error_of_B_to_E_rad);

/// Results of our filter on one path in many runs with the thesis's noise; vectors in the order of sought().
struct TurnStatistics {
  Eigen::VectorXd rms, bound;
  Eigen::VectorXd covered;  ///< share of runs with the truth within two standard errors
  CurveError curve;         ///< means of the runs' own, degrees
  double reduced_chi_squared = 0;

  /// Ratio of root-mean-square error to bound, of the worst coefficient.
  [[nodiscard]] double worst_ratio() const { return (rms.array() / bound.array()).maxCoeff(); }
};

/// The same runs for the same seed.
[[nodiscard]] TurnStatistics monte_carlo(TurnProblem problem, const std::vector<TruePoint>& path, int runs,
                                         std::uint64_t seed);

}  // namespace navcal::calib::thesis
