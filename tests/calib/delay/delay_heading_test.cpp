// SPDX-License-Identifier: Apache-2.0
#include "calib/delay/delay_heading.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::calib {
namespace {

constexpr double kTurnPeriod_s = 0.1;
constexpr double kGyroScale = 1 / 0.9, kBias_rad_s = -0.1 / 0.9;  // true rate = scale * measured + bias

/// Turns to both sides, speeding up and slowing down.
double true_heading(double t) { return 0.8 * t * 0.3 + 1.5 * std::sin(0.5 * t) + 0.6 * std::sin(1.3 * t); }

double compass_deviation(double psi) {
  return 0.09 * std::sin(psi) - 0.09 * std::cos(psi) + 0.035 * std::sin(2 * psi);
}

double measured_heading(double psi) {
  double measured = psi;
  for (int i = 0; i < 50; ++i) measured = psi + compass_deviation(measured);
  return measured;
}

struct Turns {
  double delay_s = 0.05;
  double noise_rad = 0, rate_noise_rad_sqrt_s = 0;
  std::uint64_t seed = 1;
  double (*heading)(double) = true_heading;
};

std::vector<TurnStep> steps(const Turns& turns, double duration_s) {
  std::mt19937_64 random(turns.seed);
  std::normal_distribution<double> normal;
  std::vector<TurnStep> result;
  for (int k = 0; k * kTurnPeriod_s < duration_s; ++k) {
    const double t = 10 + k * kTurnPeriod_s;
    const double measured = measured_heading(turns.heading(t - turns.delay_s)) + turns.noise_rad * normal(random);
    TurnStep step;
    step.time_s = t;
    step.heading_rad = std::remainder(measured, 2 * std::numbers::pi);
    step.begins_segment = k == 0;
    if (k > 0) {
      const double turn = turns.heading(t) - turns.heading(t - kTurnPeriod_s);
      step.duration_s = step.bias_time_s = kTurnPeriod_s;
      step.measured_angle_rad = (turn - kBias_rad_s * kTurnPeriod_s) / kGyroScale +
                                turns.rate_noise_rad_sqrt_s * std::sqrt(kTurnPeriod_s) * normal(random);
    }
    result.push_back(step);
  }
  return result;
}

HeadingDelay fed(const std::vector<TurnStep>& all, const HeadingDelay::Parameters& parameters = {}) {
  HeadingDelay delay(parameters);
  for (const TurnStep& step : all) delay.update(step, {});
  return delay;
}

std::string saved(HeadingDelay& delay) {
  Archive archive;
  delay.archive(archive);
  return archive.bytes();
}

TEST(HeadingDelay, NeitherGyroErrorsNorDeviationAreReadAsADelay) {
  for (const double delay_s : {-0.03, 0.0, 0.02, 0.05}) {
    const auto estimate = fed(steps({.delay_s = delay_s}, 60)).estimate();
    // The second order of the delay, tau^2 r' / 2, is not in the model.
    EXPECT_NEAR(estimate.delay_s, delay_s, 5e-4) << delay_s;
  }
}

TEST(HeadingDelay, StandardErrorIsHonestAndTwoMillisecondsAfterAMinute) {
  int within = 0, runs = 200;
  double worst_std_s = 0;
  for (int run = 0; run < runs; ++run) {
    const auto estimate = fed(steps({.delay_s = 0.012,
                                     .noise_rad = 0.008,
                                     .rate_noise_rad_sqrt_s = 0.0004,
                                     .seed = static_cast<std::uint64_t>(run + 1)},
                                    60),
                              {.heading_noise_rad = 0.008, .rate_noise_rad_sqrt_s = 0.0004})
                              .estimate();
    within += std::abs(estimate.delay_s - 0.012) <= 2 * estimate.std_s ? 1 : 0;
    worst_std_s = std::max(worst_std_s, estimate.std_s);
  }
  // 95.4 % of 200: 99.9 % binomial limits.
  EXPECT_GE(within, 181);
  EXPECT_LE(within, 199);
  EXPECT_LT(worst_std_s, 0.002);
}

TEST(HeadingDelay, WithoutAChangingRateItDoesNotClaimToKnow) {
  const auto steady = [](double t) { return 0.5 * t; };
  const auto estimate = fed(steps({.noise_rad = 0.004, .heading = steady}, 60)).estimate();
  EXPECT_GT(estimate.std_s, 0.1);
  EXPECT_LT(estimate.rate_spread_rad_s, 0.01);
  const auto at_rest = fed(steps({.noise_rad = 0.004, .heading = [](double) { return 3.14; }}, 60)).estimate();
  EXPECT_GT(at_rest.std_s, 0.4);
}

TEST(HeadingDelay, EqualsTheBatchSolution) {
  const auto all = steps({.noise_rad = 0.01, .rate_noise_rad_sqrt_s = 0.002}, 12);
  const HeadingDelay::Parameters parameters;
  // Generalised least squares: heading noise white, gyro noise a random walk, the priors as rows. The newest
  // reading waits for the step after it.
  const auto n = static_cast<Eigen::Index>(all.size()) - 1;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, 9);
  Eigen::VectorXd seen(n);
  double s1 = 0, s2 = 0, heading = all[0].heading_rad;
  for (Eigen::Index k = 0; k < n; ++k) {
    const TurnStep& step = all[static_cast<std::size_t>(k)];
    const TurnStep& next = all[static_cast<std::size_t>(k + 1)];
    s1 += step.measured_angle_rad;
    s2 += step.bias_time_s;
    heading += std::remainder(step.heading_rad - heading, 2 * std::numbers::pi);
    const double psi = step.heading_rad;
    const double rate =
        (step.measured_angle_rad + next.measured_angle_rad) / (step.bias_time_s + next.bias_time_s);
    rows.row(k) << 1, s1, s2, std::sin(psi), std::cos(psi), std::sin(2 * psi), std::cos(2 * psi), -rate, 0;
    seen[k] = heading;
  }
  Eigen::MatrixXd noise = Eigen::MatrixXd::Identity(n, n) * std::pow(parameters.heading_noise_rad, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      noise(i, j) +=
          std::pow(parameters.rate_noise_rad_sqrt_s, 2) * kTurnPeriod_s * static_cast<double>(std::min(i, j));
  Eigen::VectorXd prior(9), mean = Eigen::VectorXd::Unit(9, 1);
  mean[0] = all[0].heading_rad;
  prior << 10, parameters.scale_std, parameters.bias_std_rad_s,
      Eigen::VectorXd::Constant(4, parameters.deviation_std_rad), parameters.delay_std_s,
      parameters.tilt_lag_std_s;
  const Eigen::LLT<Eigen::MatrixXd> whiten(noise);
  Eigen::MatrixXd information = rows.transpose() * whiten.solve(rows);
  information.diagonal() += prior.array().square().inverse().matrix();
  const Eigen::VectorXd batch =
      mean + information.llt().solve(rows.transpose() * whiten.solve(seen - rows * mean));
  const double variance = information.inverse()(7, 7);
  const auto estimate = fed(all).estimate();
  EXPECT_NEAR(estimate.delay_s, batch[7] / batch[1], 1e-9);
  // Without what the innovations add when they are larger than stated.
  EXPECT_GE(estimate.std_s, std::sqrt(variance) / batch[1] * (1 - 1e-6));
}

TEST(HeadingDelay, GapsAndTheSeamChangeNothing) {
  auto all = steps({.delay_s = 0.04}, 90);
  for (TurnStep& step : all) step.heading_rad += 2 * std::numbers::pi * std::floor(step.time_s);  // any turn
  for (std::size_t k = 100; k < all.size(); k += 200) {
    TurnStep& step = all[k];
    step.begins_segment = true;
    step.duration_s = step.bias_time_s = step.measured_angle_rad = 0;
  }
  EXPECT_NEAR(fed(all).estimate().delay_s, 0.04, 1e-3);
}

TEST(HeadingDelay, NotANumberIsLeftOut) {
  HeadingDelay delay;
  for (const TurnStep& step : steps({}, 30)) {
    delay.update(step, {});
    TurnStep bad = step;
    bad.heading_rad = std::numeric_limits<double>::quiet_NaN();
    delay.update(bad, {});
    bad = step;
    bad.measured_angle_rad = std::numeric_limits<double>::infinity();
    delay.update(bad, {});
  }
  EXPECT_DOUBLE_EQ(delay.estimate().delay_s, fed(steps({}, 30)).estimate().delay_s);
}

TEST(HeadingDelay, SavedAndRestoredItGoesOnBitForBit) {
  const auto all = steps({.noise_rad = 0.01}, 40);
  HeadingDelay whole, first;
  for (std::size_t k = 0; k < all.size(); ++k) {
    whole.update(all[k], {});
    if (k < all.size() / 2) first.update(all[k], {});
  }
  const std::string bytes = saved(first);
  HeadingDelay second;
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  for (std::size_t k = all.size() / 2; k < all.size(); ++k) second.update(all[k], {});
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
