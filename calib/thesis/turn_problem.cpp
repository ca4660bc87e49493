// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/turn_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/turn/turn_integrator.h"

namespace navcal::calib::thesis {
namespace {

Deviation deviation_of(TurnProblem problem) {
  return problem == TurnProblem::gyro ? Deviation(Deviation::Zero()) : thesis_deviation();
}

TurnPrior prior_of(TurnProblem problem) {
  switch (problem) {
    case TurnProblem::gyro: return TurnPrior::unknown_gyro();
    case TurnProblem::compass:
      return TurnPrior::unknown_compass(kTrueScale, kTrueBias_rad_s, Eigen::Matrix2d::Zero());
    case TurnProblem::both: break;
  }
  return TurnPrior::unknown_both();
}

}  // namespace

TurnFilter turn_filter(const TurnPrior& prior) {
  TurnFilter::Parameters parameters;
  parameters.heading_noise_rad = Noise{}.heading_rad;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(kPeriod_s);
  return TurnFilter(parameters, prior);
}

std::vector<TurnStep> turn_steps(std::span<const Measured> readings) {
  TurnIntegrator integrator({});
  std::vector<TurnStep> steps;
  for (const Measured& m : readings) {
    integrator.update(compass_of(m));
    integrator.update(rate_of(m));
    while (const auto step = integrator.next()) steps.push_back(*step);
  }
  return steps;
}

TurnFilter filtered(std::span<const Measured> readings, const TurnPrior& prior) {
  TurnFilter filter = turn_filter(prior);
  for (const TurnStep& step : turn_steps(readings)) filter.update(step);
  return filter;
}

std::vector<int> sought(TurnProblem problem) {
  switch (problem) {
    case TurnProblem::gyro: return {kScale, kBias};
    case TurnProblem::compass: return {kB, kC, kD, kE};
    case TurnProblem::both: break;
  }
  return {kScale, kBias, kB, kC, kD, kE};
}

TurnCoefficients true_coefficients(TurnProblem problem) {
  TurnCoefficients all;
  all << kTrueScale, kTrueBias_rad_s, deviation_of(problem).tail<4>();
  return all;
}

std::vector<Measured> measure(TurnProblem problem, const std::vector<TruePoint>& path, const Noise& noise,
                              Random& random) {
  return thesis::measure(path, deviation_of(problem), noise, random);
}

TurnFilter filtered(TurnProblem problem, std::span<const Measured> readings) {
  return filtered(readings, prior_of(problem));
}

Eigen::VectorXd cramer_rao(TurnProblem problem, const std::vector<TruePoint>& path, const Noise& noise) {
  const Deviation deviation = deviation_of(problem);
  const std::vector<int> columns = sought(problem);
  const auto rows = static_cast<Eigen::Index>(path.size());
  Eigen::MatrixXd regressors(rows, 1 + static_cast<Eigen::Index>(columns.size()));
  Eigen::MatrixXd covariance(rows, rows);
  double S1 = 0, S2 = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto at = [&](Eigen::Index k) {
      const TruePoint& p = path[static_cast<std::size_t>(k)];
      const double factor = 1 / (std::cos(p.roll_rad) * std::cos(p.pitch_rad));
      return Eigen::Vector2d{factor * (p.rate_rad_s.z() - kTrueBias_rad_s) / kTrueScale, factor};
    };
    if (i > 0) {
      S1 += kPeriod_s / 2 * (at(i - 1)[0] + at(i)[0]);
      S2 += kPeriod_s / 2 * (at(i - 1)[1] + at(i)[1]);
    }
    const double psi_m = measured_heading_rad(deviation, path[static_cast<std::size_t>(i)].heading_rad);
    TurnCoefficients row;
    row << S1, S2, harmonics(psi_m);
    regressors(i, 0) = 1;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      regressors(i, 1 + static_cast<Eigen::Index>(c)) = row[columns[c]];
    }
    const double slope = deviation[1] * std::cos(psi_m) - deviation[2] * std::sin(psi_m) +
                         2 * deviation[3] * std::cos(2 * psi_m) - 2 * deviation[4] * std::sin(2 * psi_m);
    for (Eigen::Index j = 0; j <= i; ++j) {
      // Halves at the ends of both sums.
      const double common = j == 0 ? 0 : static_cast<double>(j) - (i == j ? 0.5 : 0.25);
      covariance(i, j) = covariance(j, i) = std::pow(kTrueScale * noise.rate_rad_s * kPeriod_s, 2) * common;
    }
    covariance(i, i) += std::pow(noise.heading_rad * (1 - slope), 2);
  }
  const Eigen::MatrixXd information = regressors.transpose() * covariance.llt().solve(regressors);
  return information.inverse().diagonal().tail(static_cast<Eigen::Index>(columns.size())).cwiseSqrt();
}

CurveError curve_error(const Eigen::Vector4d& error) {
  CurveError found;
  double square = 0;
  constexpr int kPoints = 720;
  for (int i = 0; i < kPoints; ++i) {
    const double e = error.dot(harmonics(2 * std::numbers::pi * i / kPoints)) * 180 / std::numbers::pi;
    found.largest_deg = std::max(found.largest_deg, std::abs(e));
    square += e * e;
  }
  found.deviation_deg = std::sqrt(square / kPoints);  // harmonics have no mean
  return found;
}

TurnStatistics monte_carlo(TurnProblem problem, const std::vector<TruePoint>& path, int runs, std::uint64_t seed) {
  const Noise noise;
  const std::vector<int> coefficients = sought(problem);
  const TurnCoefficients truth = true_coefficients(problem);
  Random random(seed);
  TurnStatistics statistics;
  statistics.bound = cramer_rao(problem, path, noise);
  statistics.rms = statistics.covered = Eigen::VectorXd::Zero(statistics.bound.size());
  for (int run = 0; run < runs; ++run) {
    const TurnFilter filter = filtered(problem, measure(problem, path, noise, random));
    const TurnCoefficients error = filter.estimate() - truth;
    const TurnCovariance covariance = filter.covariance();
    for (Eigen::Index i = 0; i < statistics.rms.size(); ++i) {
      const int c = coefficients[static_cast<std::size_t>(i)];
      statistics.rms[i] += error[c] * error[c] / runs;
      if (std::abs(error[c]) < 2 * std::sqrt(covariance(c, c))) statistics.covered[i] += 1.0 / runs;
    }
    const CurveError curve = curve_error(error.tail<4>());
    statistics.curve.largest_deg += curve.largest_deg / runs;
    statistics.curve.deviation_deg += curve.deviation_deg / runs;
    statistics.reduced_chi_squared += filter.reduced_chi_squared() / runs;
  }
  statistics.rms = statistics.rms.cwiseSqrt();
  return statistics;
}

}  // namespace navcal::calib::thesis
