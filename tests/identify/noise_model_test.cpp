// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/noise_model.h"

#include <gtest/gtest.h>

#include <random>

namespace navcal::identify {
namespace {

TEST(NoiseModel, FindsScaleAndCorrelationAndMakesThemWhite) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<WindowReading> readings;
  Eigen::VectorXd values(8000);
  double coloured = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const bool is_rate = i < 4000;
    readings.push_back({is_rate ? Channel::rate_x : Channel::roll, 0.1 * static_cast<double>(i), 0, 0.5});
    coloured = 0.8 * coloured + 0.6 * normal(random);
    values[i] = is_rate ? 0.5 * 3 * coloured : 0.5 * normal(random);
  }
  const NoiseModel::WindowResiduals window{&readings, &values};
  const NoiseModel model = NoiseModel::fitted_to(std::span(&window, 1), 0);
  EXPECT_NEAR(model.scale(Channel::rate_x), 3, 0.3);
  EXPECT_NEAR(model.correlation(Channel::rate_x), 0.8, 0.05);
  EXPECT_NEAR(model.scale(Channel::roll), 1, 0.05);
  EXPECT_EQ(model.correlation(Channel::roll), 0);
  Eigen::MatrixXd white = values;
  model.whiten(readings, white);
  EXPECT_NEAR(white.topRows(4000).squaredNorm() / 4000, 1, 0.1);
  EXPECT_NEAR(white.topRows(3999).cwiseProduct(white.middleRows(1, 3999)).sum() / 4000, 0, 0.06);
}

TEST(NoiseModel, FewReadingsKeepTheirNoise) {
  std::vector<WindowReading> readings(50, {Channel::north, 0, 0, 1});
  const Eigen::VectorXd values = Eigen::VectorXd::Constant(50, 0.1);
  const NoiseModel::WindowResiduals window{&readings, &values};
  EXPECT_EQ(NoiseModel::fitted_to(std::span(&window, 1), 0).scale(Channel::north), 1);
}

}  // namespace
}  // namespace navcal::identify
