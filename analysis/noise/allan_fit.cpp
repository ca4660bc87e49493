// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/allan_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace navcal::analysis {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Flat level of the Allan variance of flicker noise with B = 1.
constexpr double kFlickerLevel = 2 * std::numbers::ln2 / std::numbers::pi;
/// Points of fewer degrees of freedom have no normal distribution, even approximately.
constexpr double kLeastFreedom = 4;
constexpr double kSignificance_std = 3;
/// Deviance that a term must save: its chance is 1 % for a single one.
constexpr double kPenalty = 6.6;
constexpr double kOneSided95 = 1.645;
constexpr int kRounds = 12;
/// Readings that give three points or more with enough degrees of freedom, as any term but white noise needs.
constexpr double kLeastReadings = 64;

/// Correlation of estimates of the Allan variance that lie 0, 1, 2... octaves apart, of white noise and of a
/// random walk: sums of squared cross-covariances of the filters that the estimates are. 0 further apart than
/// these.
constexpr std::array kWhiteCorrelation{1.0, 0.53, 0.19, 0.07, 0.02};
constexpr std::array kWalkCorrelation{1.0, 0.89, 0.67, 0.49, 0.35};

struct Sampling {
  double period_s = 0;
  double lag1 = 0;  ///< correlation of consecutive readings; of those k apart, its power k
};

struct Problem {
  Columns terms;          ///< AVAR of N = 1, B = 1, K = 1
  Eigen::VectorXd lines;  ///< AVAR of the spectral lines
  Eigen::VectorXd measured;
  std::vector<std::size_t> factors;
};

struct Solution {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  ///< N^2, B^2, K^2
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::VectorXd model, edf;
  double deviance = 0;

  [[nodiscard]] double error(int term) const { return std::sqrt(covariance(term, term)); }
};

double line_variance(const SpectralLine& line, double factor, double period_s) {
  const double angle = std::numbers::pi * line.frequency_Hz * period_s;
  const double sine = std::sin(factor * angle);
  return std::pow(line.amplitude * sine * sine / (factor * std::sin(angle)), 2);
}

/// Allan variance of correlated readings whose N is 1: sums of the autocorrelation a^k over both averages.
double correlated_variance(const AllanPoint& point, double a) {
  const double m = static_cast<double>(point.factor), last = std::pow(a, m);
  return (1 - a * (1 - last) * (3 - last) / (m * (1 - a * a))) / point.tau_s;
}

/// Allan variance of a random walk whose K is 1. Readings are samples of it, not means: hence the second term.
double walk_variance(const AllanPoint& point, double period_s) {
  return point.tau_s / 3 + period_s * period_s / (6 * point.tau_s);
}

Problem problem_of(const std::vector<AllanPoint>& points, const Sampling& sampling,
                   const std::vector<SpectralLine>& lines) {
  Problem problem;
  const auto n = static_cast<Eigen::Index>(points.size());
  problem.terms.resize(n, 3);
  problem.lines = Eigen::VectorXd::Zero(n);
  problem.measured.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const AllanPoint& point = points[static_cast<std::size_t>(i)];
    problem.terms.row(i) << correlated_variance(point, sampling.lag1), kFlickerLevel,
        walk_variance(point, sampling.period_s);
    for (const auto& line : lines)
      problem.lines[i] += line_variance(line, static_cast<double>(point.factor), sampling.period_s);
    problem.measured[i] = point.deviation * point.deviation;
    problem.factors.push_back(point.factor);
  }
  return problem;
}

/// Kind of noise that contributes most to the model at a point.
NoiseKind kind_at(const Problem& problem, const Eigen::Vector3d& squares, Eigen::Index point) {
  constexpr std::array kNoiseKinds{NoiseKind::white, NoiseKind::flicker, NoiseKind::random_walk};
  Eigen::Index largest = 0;
  problem.terms.row(point).cwiseProduct(squares.transpose()).maxCoeff(&largest);
  return kNoiseKinds.at(static_cast<std::size_t>(largest));
}

double correlation(double white_share, std::size_t octaves) {
  if (octaves >= kWhiteCorrelation.size()) return 0;
  return std::lerp(kWalkCorrelation.at(octaves), kWhiteCorrelation.at(octaves), white_share);
}

/// Covariance of the measured variances where `model` is true.
Eigen::MatrixXd covariance_of_points(const Problem& problem, const Solution& solution) {
  const Eigen::Index n = problem.measured.size();
  Eigen::MatrixXd covariance(n, n);
  const auto std_of = [&](Eigen::Index i) { return solution.model[i] * std::sqrt(2 / solution.edf[i]); };
  const auto share_of = [&](Eigen::Index i) {
    return std::clamp(problem.terms(i, 0) * solution.squares[0] / solution.model[i], 0.0, 1.0);
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const double share = (share_of(i) + share_of(k)) / 2;
      covariance(i, k) = std_of(i) * std_of(k) * correlation(share, static_cast<std::size_t>(std::abs(i - k)));
    }
  }
  return covariance;
}

/// Weighted least squares for the terms in `used`, with the weights of solution.model and solution.edf.
void solve(const Problem& problem, const std::vector<int>& used, Solution& solution) {
  const auto count = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd columns(problem.terms.rows(), count);
  for (Eigen::Index i = 0; i < count; ++i) columns.col(i) = problem.terms.col(used[static_cast<std::size_t>(i)]);
  const Eigen::VectorXd weights = solution.edf.array() / (2 * solution.model.array().square());
  const Eigen::MatrixXd weighted = weights.asDiagonal() * columns;
  const Eigen::MatrixXd gain = (columns.transpose() * weighted).ldlt().solve(weighted.transpose());
  const Eigen::VectorXd squares = gain * (problem.measured - problem.lines);
  const Eigen::MatrixXd covariance = gain * covariance_of_points(problem, solution) * gain.transpose();
  solution.squares.setZero();
  solution.covariance.setZero();
  for (Eigen::Index i = 0; i < count; ++i) {
    const int row = used[static_cast<std::size_t>(i)];
    solution.squares[row] = squares[i];
    for (Eigen::Index k = 0; k < count; ++k)
      solution.covariance(row, used[static_cast<std::size_t>(k)]) = covariance(i, k);
  }
}

/// The fit of a set of terms; nullopt if one of them is not positive.
std::optional<Solution> fitted(const Problem& problem, const Pieces& pieces, const std::vector<int>& used) {
  Solution solution;
  const Eigen::Index n = problem.measured.size();
  solution.model = problem.measured;
  solution.edf.resize(n);
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const NoiseKind kind = round == 0 ? NoiseKind::white : kind_at(problem, solution.squares, i);
      solution.edf[i] = allan_edf(kind, pieces, problem.factors[static_cast<std::size_t>(i)]);
    }
    solve(problem, used, solution);
    for (const int term : used) {
      if (!(solution.squares[term] > 0)) return std::nullopt;
    }
    solution.model = problem.terms * solution.squares + problem.lines;
  }
  const Eigen::ArrayXd ratio = problem.measured.array() / solution.model.array();
  solution.deviance = (solution.edf.array() * (ratio - 1 - ratio.log())).sum();
  return solution;
}

bool all_significant(const Solution& solution, const std::vector<int>& used) {
  return std::all_of(used.begin(), used.end(),
                     [&](int term) { return solution.squares[term] > kSignificance_std * solution.error(term); });
}

struct Choice {
  std::vector<int> used;
  Solution solution;
};

std::optional<Choice> best_of(const Problem& problem, const Pieces& pieces) {
  static const std::vector<std::vector<int>> kSets{{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}};
  std::optional<Choice> best;
  const auto score = [](const Choice& choice) {
    return choice.solution.deviance + kPenalty * static_cast<double>(choice.used.size());
  };
  for (const auto& used : kSets) {
    if (static_cast<Eigen::Index>(used.size()) > problem.measured.size()) continue;
    const auto solution = fitted(problem, pieces, used);
    if (!solution || !all_significant(*solution, used)) continue;
    const Choice choice{used, *solution};
    if (!best || score(choice) < score(*best)) best = choice;
  }
  return best;
}

/// Readings without a gap from which a term of this size, beside the others in `solution`, would stand out.
std::optional<double> readings_needed(Solution solution, const std::vector<int>& used, int term, double square,
                                      const Sampling& sampling, double readings) {
  constexpr int kMostSteps = 80;
  constexpr double kStep = 1.19;  // a fourth of an octave
  solution.squares[term] = square;
  for (int step = 0; step < kMostSteps; ++step, readings *= kStep) {
    std::vector<AllanPoint> points;
    for (std::size_t m = 1; 2 * static_cast<double>(m) <= readings; m *= 2) {
      AllanPoint point;
      point.factor = m;
      point.tau_s = static_cast<double>(m) * sampling.period_s;
      points.push_back(point);
    }
    Problem problem = problem_of(points, sampling, {});
    problem.measured = solution.model = problem.terms * solution.squares;
    solution.edf.resize(problem.measured.size());
    for (Eigen::Index i = 0; i < solution.edf.size(); ++i)
      solution.edf[i] = allan_edf(kind_at(problem, solution.squares, i), static_cast<std::size_t>(readings),
                                  problem.factors[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d squares = solution.squares;
    solve(problem, used, solution);
    solution.squares = squares;
    if (square > kSignificance_std * solution.error(term)) return readings;
  }
  return std::nullopt;
}

/// A term that the best set does not have: its limit beside that set, and the length that would show it.
NoiseTerm absent_term(const Problem& problem, const Choice& choice, int term, const Sampling& sampling,
                      double readings) {
  NoiseTerm absent;
  std::vector<int> used = choice.used;
  used.push_back(term);
  if (static_cast<Eigen::Index>(used.size()) > problem.measured.size()) return absent;
  Solution solution = choice.solution;
  solve(problem, used, solution);
  const double limit = std::max(solution.squares[term], 0.0) + kOneSided95 * solution.error(term);
  if (!(limit > 0) || !std::isfinite(limit)) return absent;
  absent.limit = std::sqrt(limit);
  if (term == 0) return absent;  // a longer recording has no more short times
  const auto needed = readings_needed(choice.solution, used, term, limit, sampling, readings);
  if (needed) absent.needs_s = *needed * sampling.period_s;
  return absent;
}

NoiseTerm present_term(const Solution& solution, int term) {
  NoiseTerm present;
  present.value = std::sqrt(solution.squares[term]);
  present.error = solution.error(term) / (2 * *present.value);
  return present;
}

}  // namespace

AllanFit fit_allan(std::vector<AllanPoint>& points, const Pieces& pieces, double period_s, double shortest_s,
                   double lag1, const std::vector<SpectralLine>& lines) {
  const Sampling sampling{period_s, lag1};
  std::vector<AllanPoint> usable;
  for (const AllanPoint& point : points) {
    const bool long_enough = point.tau_s > shortest_s - period_s / 2;
    if (long_enough && point.deviation > 0 && point.edf >= kLeastFreedom) usable.push_back(point);
  }
  AllanFit fit;
  const double readings = static_cast<double>(reading_count(pieces)), duration_s = readings * period_s;
  const double least_s = kLeastReadings * std::max(period_s, shortest_s);
  for (NoiseTerm* term : {&fit.white, &fit.flicker, &fit.walk}) {
    if (duration_s < least_s) term->needs_s = least_s;
  }
  if (usable.empty()) return fit;
  const Problem problem = problem_of(usable, sampling, lines);
  const auto best = best_of(problem, pieces);
  if (!best) return fit;
  const std::array terms{&fit.white, &fit.flicker, &fit.walk};
  for (int term = 0; term < 3; ++term) {
    NoiseTerm& found = *terms.at(static_cast<std::size_t>(term));
    const bool present = std::find(best->used.begin(), best->used.end(), term) != best->used.end();
    if (present)
      found = present_term(best->solution, term);
    else if (duration_s >= least_s)
      found = absent_term(problem, *best, term, sampling, readings);
  }
  const Problem all = problem_of(points, sampling, lines);
  for (std::size_t i = 0; i < points.size(); ++i)
    set_confidence(points[i], allan_edf(kind_at(all, best->solution.squares, static_cast<Eigen::Index>(i)), pieces,
                                        points[i].factor));
  return fit;
}

}  // namespace navcal::analysis
