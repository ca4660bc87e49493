// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string_view>

#include "identify/fit/fit_problem.h"

namespace navcal::identify {

/// Called with what is done and 0 to 1 of it; it may throw to end the fit.
using FitProgress = std::function<void(std::string_view, double)>;

struct Descent {
  Unknowns unknowns;
  double cost;
  int iterations = 0;
  bool converged = false;
};

/// Least cost by Levenberg and Marquardt in at most `most` steps from these unknowns, with the noise as it is.
[[nodiscard]] Descent minimise(const FitProblem& problem, Unknowns unknowns, int most,
                               FitProblem::Parameters which, const FitProgress& progress,
                               std::string_view what = "fit");

struct Estimate {
  Unknowns unknowns;
  Eigen::VectorXd stds;               ///< of the parameters, in their units
  Eigen::MatrixXd covariance;         ///< of the parameters
  Eigen::MatrixXd border_covariance;  ///< of parameters and nuisances
  double model_error = 1;             ///< variance of the windows' scores over that of white residuals, at least 1
  double cost = 0;
  int iterations = 0;
  bool converged = false;
};

/// Maximum a posteriori estimate by Levenberg and Marquardt, with the noise of the residuals estimated in between
/// (feasible generalised least squares), and its covariance.
///
/// The covariance is A^-1 (B + P) A^-1 with P the priors' precision, A = H + P the information without the states,
/// and B the covariance of the score. Under the model B = H. It is estimated from the scores of the single
/// windows, with those of neighbouring windows (a heteroskedasticity and autocorrelation consistent estimate with
/// Bartlett's weights: Newey and West 1987, Econometrica 55), which holds whatever the residuals are like. Few
/// windows determine few directions of B, therefore it is drawn to c H, with c the mean of the empirical over the
/// expected variance and at least 1; the weight of the empirical B is n/(n + 5 m) for n windows and m unknowns.
[[nodiscard]] Estimate estimate(FitProblem& problem, const FitProgress& progress);

/// The same with fixed parameters: nuisances and states only, with the noise as it is. The cost then judges
/// parameters.
[[nodiscard]] Unknowns fit_nuisances(const FitProblem& problem, Unknowns unknowns, const FitProgress& progress);

}  // namespace navcal::identify
