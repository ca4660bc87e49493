// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/turn/turn_filter.h"

/// The recursive filter against the same estimate with all readings at once and dense matrices.
namespace navcal::calib {
namespace {

std::vector<TurnStep> steps(int count, double noise_rad) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, noise_rad);
  std::vector<TurnStep> all;
  double heading = 1;
  for (int i = 0; i < count; ++i) {
    TurnStep step;
    step.time_s = 0.1 * i;
    step.begins_segment = i == 0;
    if (i > 0) {
      step.duration_s = 0.1;
      const double rate = 0.6 * std::sin(0.07 * i) + 0.2;
      step.bias_time_s = 0.1 * (1 + 0.01 * std::sin(0.3 * i));
      step.tilt_angle_rad = 0.001 * std::cos(0.2 * i);
      step.measured_angle_rad = step.bias_time_s * (rate - 0.05) / 1.05;
      heading += step.bias_time_s * rate + step.tilt_angle_rad;
    }
    step.heading_rad = std::remainder(heading + 0.08 * std::sin(heading) + normal(random), 2 * M_PI);
    all.push_back(step);
  }
  return all;
}

/// Generalised least squares with the corrected score; the scale's weight in the noise is the prior's.
TurnCoefficients batch(const std::vector<TurnStep>& all, const TurnFilter::Parameters& p, const TurnPrior& prior) {
  const auto n = static_cast<Eigen::Index>(all.size());
  const bool scale_held = prior.covariance(kScale, kScale) == 0;
  Eigen::MatrixXd rows(n, 6), nuisance(n, 2), slopes = Eigen::MatrixXd::Zero(n, 6);
  Eigen::VectorXd walk(n);
  double turned = 0, S1 = 0, S2 = 0, T = 0, angle_variance = 0, before = all[0].heading_rad;
  for (Eigen::Index i = 0; i < n; ++i) {
    const TurnStep& s = all[static_cast<std::size_t>(i)];
    S1 += s.measured_angle_rad;
    S2 += s.bias_time_s;
    T += s.tilt_angle_rad;
    turned += i == 0 ? s.heading_rad : std::remainder(s.heading_rad - before, 2 * M_PI);
    before = s.heading_rad;
    if (i > 0) angle_variance += std::pow(p.rate_noise_rad_sqrt_s * s.bias_time_s, 2) / s.duration_s;
    walk[i] = angle_variance;
    const double h = s.heading_rad;
    rows.row(i) << turned - T - prior.mean[kScale] * S1, scale_held ? 0 : S1, std::sin(h), std::cos(h),
        std::sin(2 * h), std::cos(2 * h);
    slopes.row(i) << 1, 0, std::cos(h), -std::sin(h), 2 * std::cos(2 * h), -2 * std::sin(2 * h);
    nuisance.row(i) << 1, S2;
  }
  rows.col(0) -= prior.mean[kBias] * nuisance.col(1);
  Eigen::MatrixXd walks(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) walks(i, j) = walk[std::min(i, j)];
  }
  const double variance = p.heading_noise_rad * p.heading_noise_rad, scale = prior.mean[kScale];
  const Eigen::MatrixXd covariance = scale * scale * walks + variance * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd weight = covariance.inverse();
  Eigen::Matrix2d nuisance_information = nuisance.transpose() * weight * nuisance;
  if (prior.covariance(kBias, kBias) > 0)
    nuisance_information(1, 1) += 1 / prior.covariance(kBias, kBias);
  else
    nuisance_information(1, 1) = 1e30;
  const Eigen::MatrixXd gain = nuisance_information.inverse() * nuisance.transpose() * weight;
  const Eigen::MatrixXd projected = weight - weight * nuisance * gain;
  const Eigen::MatrixXd products = rows.transpose() * projected * rows;
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index i = 0; i < n; ++i)
    noise += variance * projected(i, i) * slopes.row(i).transpose() * slopes.row(i);
  Eigen::VectorXd by_rate = Eigen::VectorXd::Zero(6);
  by_rate[0] = -scale;
  by_rate[1] = scale_held ? 0 : 1;
  noise += projected.cwiseProduct(walks).sum() * by_rate * by_rate.transpose();

  Eigen::VectorXd belief(5);
  belief << (scale_held ? 1 : 1 / prior.covariance(0, 0)), 0.01, 0.01, 0.01, 0.01;
  const Eigen::MatrixXd information = products.bottomRightCorner(5, 5) + Eigen::MatrixXd(belief.asDiagonal());
  Eigen::VectorXd found = information.ldlt().solve(products.col(0).tail(5));
  const double count = static_cast<double>(n - 1);
  const double sought = scale_held ? 4 : 6;
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::VectorXd at(6);
    at << 1, -found;
    const double ratio = at.dot(products * at) / (at.dot(noise * at) * (1 - sought / count));
    found = (information - ratio * noise.bottomRightCorner(5, 5))
                .ldlt()
                .solve(products.col(0).tail(5) - ratio * noise.col(0).tail(5));
  }
  TurnCoefficients all_found = prior.mean;
  all_found[kScale] += found[0];
  all_found[kBias] += (gain * (rows.col(0) - rows.rightCols(5) * found))[1];
  all_found.tail<4>() += found.tail(4);
  return all_found;
}

TurnCoefficients recursive(const std::vector<TurnStep>& all, const TurnFilter::Parameters& p,
                           const TurnPrior& prior) {
  TurnFilter filter(p, prior);
  for (const TurnStep& step : all) filter.update(step);
  return filter.estimate();
}

TEST(TurnFilterBatch, BothTogetherWithNoiseOfTheCompass) {
  TurnFilter::Parameters p;
  p.rate_noise_rad_sqrt_s = 0;
  const auto all = steps(200, 0.004);
  const TurnCoefficients difference =
      recursive(all, p, TurnPrior::unknown_both()) - batch(all, p, TurnPrior::unknown_both());
  EXPECT_LT(difference.norm(), 1e-9);
}

TEST(TurnFilterBatch, CompassWithNoiseOfBoth) {
  const TurnFilter::Parameters p;
  const TurnPrior prior = TurnPrior::unknown_compass(1.05, 0.05, Eigen::Matrix2d::Zero());
  const auto all = steps(200, 0.004);
  EXPECT_LT((recursive(all, p, prior) - batch(all, p, prior)).norm(), 1e-9);
}

}  // namespace
}  // namespace navcal::calib
