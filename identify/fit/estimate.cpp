// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace navcal::identify {
namespace {

constexpr int kMostIterations = 25;
constexpr int kNoisePasses = 2;
constexpr double kSettled = 0.01;  ///< of the cost: no standard error's worth is left
constexpr double kFirstDamping = 1e-4, kGreatestDamping = 1e8;
constexpr std::size_t kLag = 2;  ///< windows that count as correlated
constexpr double kWindowsPerUnknown = 5;

Unknowns moved(const FitProblem& problem, const Unknowns& from, const ChainSystem::Solution& step,
               const ChainSystem& system) {
  Unknowns to = from;
  for (Eigen::Index i = 0; i < to.parameters.size(); ++i) {
    const Parameter& parameter = problem.parameters()[static_cast<std::size_t>(i)];
    to.parameters[i] = std::clamp(to.parameters[i] + step.border[i], parameter.low, parameter.high);
  }
  for (std::size_t r = 0; r < to.states.size(); ++r) {
    to.calibrations[r] += step.border.segment<kNuisances>(system.nuisances_at(r));
    for (std::size_t k = 0; k < to.states[r].size(); ++k) to.states[r][k] += step.states[r][k];
  }
  return to;
}

/// Covariance of the score of one recording: its own windows, and neighbours with Bartlett's weights.
Eigen::MatrixXd score_covariance(const Eigen::MatrixXd& scores) {
  const Eigen::Index n = scores.cols();
  Eigen::MatrixXd sum = scores * scores.transpose();
  for (std::size_t lag = 1; lag <= kLag; ++lag) {
    const auto l = static_cast<Eigen::Index>(lag);
    if (l >= n) break;
    const double weight = 1 - static_cast<double>(lag) / static_cast<double>(kLag + 1);
    const Eigen::MatrixXd across = scores.leftCols(n - l) * scores.rightCols(n - l).transpose();
    sum += weight * (across + across.transpose());
  }
  return sum;
}

Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  return scale.asDiagonal() *
         Eigen::LDLT<Eigen::MatrixXd>(scaled).solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols())) *
         scale.asDiagonal();
}

void add_covariance(const FitProblem& problem, const FitProblem::Linearised& linearised, Estimate& estimate) {
  const ChainSystem& system = linearised.system;
  const Eigen::MatrixXd information = system.information();
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(information.rows(), information.cols());
  for (std::size_t i = 0; i < problem.parameters().size(); ++i) {
    const double std = problem.parameters()[i].prior_std;
    prior(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) = 1 / (std * std);
  }
  double windows = 0;
  Eigen::MatrixXd empirical = Eigen::MatrixXd::Zero(information.rows(), information.cols());
  for (std::size_t r = 0; r < problem.recordings().size(); ++r) {
    const Calibration stds = nuisance_stds(problem.recordings()[r]);
    const Eigen::Index at = system.nuisances_at(r);
    prior.diagonal().segment<kNuisances>(at) = stds.cwiseAbs2().cwiseInverse();
    empirical += score_covariance(system.effective_scores(r, linearised.windows[r]));
    windows += static_cast<double>(linearised.windows[r].size());
  }
  const Eigen::MatrixXd data = information - prior;
  const Eigen::MatrixXd model = inverse_of(information);
  // In the directions of the estimate: trace(A^-1 B) over trace(A^-1 H), which counts what the data determine.
  const double expected = model.cwiseProduct(data.transpose()).sum();
  const double found = model.cwiseProduct(empirical.transpose()).sum();
  // The fit brings the sum of the scores to zero, which takes out as much as one window of all, and of its
  // neighbours.
  const double left = std::max(1 - static_cast<double>(1 + kLag) / std::max(windows, 1.0), 0.5);
  estimate.model_error = expected > 0 ? std::max(found / (expected * left), 1.0) : 1;
  const double weight = windows / (windows + kWindowsPerUnknown * std::max(expected, 1.0));
  const Eigen::MatrixXd score = weight * empirical + (1 - weight) * estimate.model_error * data + prior;
  const Eigen::MatrixXd robust = model * score * model;
  // Never less than the model alone would give.
  const Eigen::VectorXd grown = (robust.diagonal().cwiseQuotient(model.diagonal())).cwiseMax(1).cwiseSqrt();
  const Eigen::VectorXd model_stds = model.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      model_stds.cwiseInverse().asDiagonal() * model * model_stds.cwiseInverse().asDiagonal();
  const Eigen::VectorXd stds = grown.cwiseProduct(model_stds);
  estimate.border_covariance = stds.asDiagonal() * correlation * stds.asDiagonal();
  const auto parameters = static_cast<Eigen::Index>(problem.parameters().size());
  estimate.covariance = estimate.border_covariance.topLeftCorner(parameters, parameters);
  estimate.stds = estimate.covariance.diagonal().cwiseSqrt();
}

}  // namespace

Descent minimise(const FitProblem& problem, Unknowns unknowns, int most, FitProblem::Parameters which,
                 const FitProgress& progress, std::string_view what) {
  Descent descent{std::move(unknowns), 0};
  descent.cost = problem.cost(descent.unknowns);
  double damping = kFirstDamping;
  while (descent.iterations < most && !descent.converged) {
    progress(what, static_cast<double>(descent.iterations) / most);
    const auto linearised = problem.linearise(descent.unknowns, which);
    ++descent.iterations;
    for (;;) {
      const auto step = linearised.system.solve(damping);
      Unknowns next = moved(problem, descent.unknowns, step, linearised.system);
      const double cost = problem.cost(next);
      if (cost <= descent.cost) {
        descent.converged = descent.cost - cost < kSettled;
        descent.cost = cost;
        descent.unknowns = std::move(next);
        damping = std::max(damping / 10, 1e-9);
        break;
      }
      damping *= 10;
      if (damping > kGreatestDamping) {
        descent.converged = true;
        break;
      }
    }
  }
  return descent;
}

Estimate estimate(FitProblem& problem, const FitProgress& progress) {
  // States and nuisances first: the parameters would be moved to mend a poor guess of them.
  constexpr int kFewFirst = 6;
  Descent descent =
      minimise(problem, problem.initial(), kFewFirst, FitProblem::Parameters::fixed, progress, "states");
  Estimate estimate;
  for (int pass = 0; pass <= kNoisePasses; ++pass) {
    descent = minimise(problem, std::move(descent.unknowns), kMostIterations, FitProblem::Parameters::free,
                       progress, "fit");
    estimate.iterations += descent.iterations;
    if (pass < kNoisePasses) problem.fit_noise(descent.unknowns);
  }
  estimate.unknowns = std::move(descent.unknowns);
  estimate.cost = descent.cost;
  estimate.converged = descent.converged;
  progress("standard errors", 0);
  add_covariance(problem, problem.linearise(estimate.unknowns), estimate);
  return estimate;
}

Unknowns fit_nuisances(const FitProblem& problem, Unknowns unknowns, const FitProgress& progress) {
  return minimise(problem, std::move(unknowns), kMostIterations, FitProblem::Parameters::fixed, progress,
                  "held out")
      .unknowns;
}

}  // namespace navcal::identify
