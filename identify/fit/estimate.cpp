// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

namespace navcal::identify {
namespace {

using Point = PredictionErrorProblem::Point;
using Parameters = PredictionErrorProblem::Parameters;

constexpr int kFewSteps = 6, kMostSteps = 12, kRounds = 3;
constexpr double kRoundSettled = 0.5;  ///< of the cost, from round to round
constexpr std::size_t kLag = 2;        ///< blocks that count as correlated
constexpr double kBlocksPerUnknown = 5;
constexpr double kApart = 2;  ///< stated errors between the ends of two starts that are not chance

/// Disturbances so strong that the filter follows the readings: steps from one to the next remain.
FilterNoises equation_error() {
  FilterNoises noises;
  noises.white *= 10;
  noises.coloured *= 3;
  noises.tau_s = 1;
  return noises;
}

/// Covariance of the score of one recording: its own blocks, and neighbours with Bartlett's weights.
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

/// The scatter of the estimates that the recordings would give one by one, as a variance of their mean; zero for
/// one recording.
Eigen::VectorXd variance_between(const PredictionErrorProblem& problem,
                                 const PredictionErrorProblem::Linearised& linear) {
  const auto recordings = linear.information_of.size();
  const auto parameters = std::ssize(problem.parameters());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(parameters), sum = square;
  if (recordings < 2) return square;
  const auto n = static_cast<double>(recordings);
  for (std::size_t r = 0; r < recordings; ++r) {
    const Eigen::Index first = linear.first_of_blocks[r], end = linear.first_of_blocks[r + 1];
    const Eigen::VectorXd score = linear.block_scores.middleCols(first, end - first).rowwise().sum();
    Eigen::MatrixXd information = linear.information_of[r];
    information.diagonal() += problem.precision();
    // Each has its share of the priors' pull.
    const Eigen::VectorXd away = (inverse_of(information) * (score - linear.score / n)).head(parameters);
    sum += away;
    square += away.cwiseAbs2();
  }
  return (square - sum.cwiseAbs2() / n).cwiseMax(0) / (n * (n - 1));
}

/// Standard errors times these factors, correlations as they are.
void grow(Estimate& estimate, Eigen::Index parameters, const Eigen::VectorXd& factors) {
  estimate.border_covariance = factors.asDiagonal() * estimate.border_covariance * factors.asDiagonal();
  estimate.covariance = estimate.border_covariance.topLeftCorner(parameters, parameters);
  estimate.stds = estimate.covariance.diagonal().cwiseSqrt();
}

void add_covariance(const PredictionErrorProblem& problem, Estimate& estimate) {
  const auto linear = problem.linearise(estimate.point, Parameters::free);
  const Eigen::MatrixXd& data = linear.information;
  const Eigen::MatrixXd prior = problem.precision().asDiagonal();
  const Eigen::MatrixXd model = inverse_of(data + prior);
  Eigen::MatrixXd empirical = Eigen::MatrixXd::Zero(data.rows(), data.cols());
  for (std::size_t r = 0; r + 1 < linear.first_of_blocks.size(); ++r) {
    const Eigen::Index first = linear.first_of_blocks[r], end = linear.first_of_blocks[r + 1];
    empirical += score_covariance(linear.block_scores.middleCols(first, end - first));
  }
  // In the directions of the estimate: trace(A^-1 B) over trace(A^-1 H), which counts what the data determine.
  const double expected = model.cwiseProduct(data.transpose()).sum();
  const double found = model.cwiseProduct(empirical.transpose()).sum();
  // The fit brings the sum of the scores to zero, which takes out as much as one block of all, and of its
  // neighbours.
  const auto blocks = static_cast<double>(linear.block_scores.cols());
  const double left = std::max(1 - static_cast<double>(1 + kLag) / std::max(blocks, 1.0), 0.5);
  estimate.model_error = expected > 0 ? std::max(found / (expected * left), 1.0) : 1;
  const double weight = blocks / (blocks + kBlocksPerUnknown * std::max(expected, 1.0));
  const Eigen::MatrixXd score = weight * empirical + (1 - weight) * estimate.model_error * data + prior;
  const Eigen::MatrixXd robust = model * score * model;
  const auto parameters = std::ssize(problem.parameters());
  Eigen::VectorXd variance = robust.diagonal().cwiseMax(model.diagonal());
  variance.head(parameters) = variance.head(parameters).cwiseMax(variance_between(problem, linear));
  estimate.border_covariance = model;
  grow(estimate, parameters, variance.cwiseQuotient(model.diagonal()).cwiseSqrt());
}

/// Instruments and disturbances at these unknowns, the parameters as they are.
Point settled_at(PredictionErrorProblem& problem, const Eigen::VectorXd& unknowns, const FitProgress& progress) {
  Point point = problem.minimise(problem.at(unknowns), kFewSteps / 2, Parameters::fixed, progress, "instruments");
  if (point.passes.empty()) return point;
  progress("disturbances", 0);
  problem.fit_noises(point, false);
  Point again = problem.at(std::move(point.unknowns));
  again.steps = point.steps;
  return again;
}

/// One way to begin, followed so far that the ways can be compared; the noises are those of its end.
Point begun(PredictionErrorProblem& problem, bool by_equation_error, const FitProgress& progress) {
  problem.set_noises(FilterNoises{});
  Eigen::VectorXd unknowns = problem.with_delays(problem.start());
  if (by_equation_error) {
    problem.set_noises(equation_error());
    unknowns =
        problem.minimise(problem.at(unknowns), kFewSteps, Parameters::free, progress, "equation error").unknowns;
    problem.set_noises(FilterNoises{});
  }
  Point point = settled_at(problem, unknowns, progress);
  if (point.passes.empty()) return point;
  return problem.minimise(std::move(point), kFewSteps, Parameters::free, progress, "fit");
}

Eigen::VectorXd unknowns_with(const PredictionErrorProblem& problem, const Eigen::VectorXd& parameters) {
  Eigen::VectorXd unknowns = problem.start();
  unknowns.head(parameters.size()) = parameters;
  return problem.with_delays(std::move(unknowns));
}

/// Disturbances and parameters in turn.
Estimate settled(PredictionErrorProblem& problem, Point point, int steps, const FitProgress& progress) {
  Estimate estimate;
  estimate.iterations = steps;
  for (int round = 0; round < kRounds && !estimate.converged; ++round) {
    progress("disturbances", static_cast<double>(round) / kRounds);
    if (point.passes.empty()) break;
    problem.fit_noises(point, round == 0);
    const double before = problem.at(point.unknowns).cost;
    point = problem.minimise(problem.at(point.unknowns), kMostSteps, Parameters::free, progress, "fit");
    estimate.iterations += point.steps;
    estimate.converged = point.is_settled && before - point.cost < kRoundSettled;
  }
  if (point.passes.empty()) throw std::invalid_argument("the vehicle leaves all bounds along the recordings");
  estimate.unknowns = point.unknowns;
  estimate.point = std::move(point);
  progress("standard errors", 0);
  add_covariance(problem, estimate);
  return estimate;
}

}  // namespace

Estimate estimate(PredictionErrorProblem& problem, const FitProgress& progress) {
  Point point = begun(problem, false, progress);
  const FilterNoises noises = problem.noises();
  Point other = begun(problem, true, progress);
  const int steps = point.steps + other.steps;
  if (other.cost < point.cost) {
    std::swap(point, other);
  } else {
    problem.set_noises(noises);
  }
  Estimate estimate = settled(problem, std::move(point), steps, progress);
  if (other.passes.empty()) return estimate;
  const Eigen::VectorXd apart = (estimate.unknowns - other.unknowns).head(estimate.stds.size());
  const Eigen::ArrayXd spread = apart.cwiseQuotient(estimate.stds).cwiseAbs();
  estimate.start_spread = spread.maxCoeff();
  // The recordings have not told a number on which the two searches disagree.
  Eigen::VectorXd grown = Eigen::VectorXd::Ones(estimate.border_covariance.rows());
  grown.head(spread.size()) = (spread > kApart).select((1 + spread.square()).sqrt(), 1);
  grow(estimate, spread.size(), grown);
  return estimate;
}

Estimate estimate_from(PredictionErrorProblem& problem, const Eigen::VectorXd& parameters,
                       const FitProgress& progress) {
  problem.set_noises(FilterNoises{});
  return settled(problem, settled_at(problem, unknowns_with(problem, parameters), progress), 0, progress);
}

}  // namespace navcal::identify
