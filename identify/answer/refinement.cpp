// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "identify/answer/prediction.h"
#include "identify/fit/estimate.h"

namespace navcal::identify {
namespace {

constexpr double kEvery_s = 2;  ///< between starts
constexpr int kRefineSteps = 15;
constexpr double kGainSettled = 0.05;  ///< of the cost

/// Root mean squares of position and heading, by the time after the start.
using Scales = std::map<double, std::array<double, 2>>;

Scales scales_of(const std::vector<LayoutError>& errors) {
  Scales squares;
  std::map<double, double> counts;
  for (const LayoutError& error : errors) {
    auto& [position, heading] = squares[error.after_s];
    position += (error.north_m * error.north_m + error.east_m * error.east_m) / 2;
    heading += error.heading_rad * error.heading_rad;
    ++counts[error.after_s];
  }
  for (auto& [after_s, scales] : squares)
    for (double& scale : scales) scale = std::max(std::sqrt(scale / counts[after_s]), 1e-9);
  return squares;
}

/// Errors over their scales; those that overlap count as one in their length, and horizons share the weight.
Eigen::VectorXd over(const Scales& scales, const std::vector<LayoutError>& errors) {
  Eigen::VectorXd all(3 * std::ssize(errors));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const LayoutError& error = errors[i];
    const auto& [position, heading] = scales.at(error.after_s);
    const double weight = std::sqrt(kEvery_s / error.after_s / static_cast<double>(scales.size()));
    all.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        weight * Eigen::Vector3d(error.north_m / position, error.east_m / position, error.heading_rad / heading);
  }
  return all;
}

}  // namespace

std::optional<Refinement> refined(const config::Layout& prior, const std::vector<Parameter>& parameters,
                                  Eigen::VectorXd start, const std::vector<RecordedMotion>& recordings,
                                  unsigned threads) {
  using Errors = std::optional<std::vector<LayoutError>>;
  const auto at = [&](const Eigen::VectorXd& values) -> Errors {
    Prediction of = predict({with_values(prior, parameters, values), recordings, {}, kEvery_s}, [](double) {});
    if (of.diverged > 0) return std::nullopt;
    return std::move(of.of_layout);
  };
  const Eigen::Index count = start.size();
  const Eigen::VectorXd priors = prior_values(parameters);
  const Eigen::VectorXd precision = prior_stds(parameters).cwiseAbs2().cwiseInverse();
  const Eigen::VectorXd low = lower_bounds(parameters), high = upper_bounds(parameters);
  Refinement answer{std::move(start), {}, 1};
  Eigen::VectorXd& here = answer.parameters;
  Errors errors = at(here);
  if (!errors || errors->empty()) return std::nullopt;
  const Scales before = scales_of(*errors);
  const double independent = over(before, *errors).squaredNorm();  // that is the sum of the squared weights
  // A fit of so many numbers leaves residuals that are smaller than the errors, by this factor.
  const auto left_by_fit = [&] {
    const double told = static_cast<double>(count) - precision.dot(answer.covariance.diagonal());
    return std::sqrt(std::max(1 - told / independent, 0.25));
  };
  Scales scales = before;
  bool is_last = false;
  for (int step = 0; step < kRefineSteps; ++step) {
    const Eigen::VectorXd residual = over(scales, *errors);
    const auto cost_of = [&](const Eigen::VectorXd& residuals, const Eigen::VectorXd& values) {
      return residuals.squaredNorm() + precision.dot((values - priors).cwiseAbs2());
    };
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(residual.size(), count);
    base::in_parallel(threads, parameters.size(), [&](std::size_t i) {
      const auto column = static_cast<Eigen::Index>(i);
      double difference = 0.01 * parameters[i].prior_std;
      if (here[column] + difference > high[column]) difference = -difference;
      const auto there = at(here + difference * Eigen::VectorXd::Unit(count, column));
      if (there) jacobian.col(column) = (over(scales, *there) - residual) / difference;
    });
    Eigen::MatrixXd information = jacobian.transpose() * jacobian;
    information.diagonal() += precision;
    const Eigen::VectorXd score = -jacobian.transpose() * residual - precision.cwiseProduct(here - priors);
    answer.covariance = Eigen::LDLT<Eigen::MatrixXd>(information).solve(Eigen::MatrixXd::Identity(count, count));
    Eigen::VectorXd change = step_within(information, score, here, low, high);
    const double cost = cost_of(residual, here);
    double gain = 0;
    for (int halving = 0; halving < 8 && gain <= 0; ++halving, change /= 2) {
      auto next = at(here + change);
      if (!next) continue;
      gain = cost - cost_of(over(scales, *next), here + change);
      if (gain <= 0) continue;
      here += change;
      errors = std::move(next);
    }
    if (gain >= kGainSettled) continue;
    if (is_last) break;
    is_last = true;
    scales = scales_of(*errors);
    for (auto& [after_s, of] : scales)
      for (double& scale : of) scale /= left_by_fit();
  }
  double sum = 0;
  for (const auto& [after_s, after] : scales_of(*errors))
    for (std::size_t i = 0; i < after.size(); ++i) sum += std::log(after.at(i) / before.at(after_s).at(i));
  answer.error_ratio = std::exp(sum / (2 * static_cast<double>(before.size()))) / left_by_fit();
  return answer;
}

}  // namespace navcal::identify
