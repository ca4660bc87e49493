// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/directions.h"

#include <gtest/gtest.h>

namespace navcal::identify {
namespace {

Parameter uncertain(const std::string& name, const std::string& unit, double prior, double std) {
  return {name, unit, prior, std, -1e9, 1e9, name, {0}};
}

/// Posterior after one measurement of a . theta with this standard deviation.
Eigen::MatrixXd measured(const std::vector<Parameter>& parameters, const Eigen::VectorXd& a, double std) {
  const Eigen::MatrixXd prior = prior_stds(parameters).cwiseAbs2().asDiagonal();
  const Eigen::VectorXd gain = prior * a / (a.dot(prior * a) + std * std);
  return prior - gain * (prior * a).transpose();
}

TEST(Directions, NamesASum) {
  const std::vector<Parameter> all{uncertain("mass", "kg", 10, 1), uncertain("added", "kg", 5, 1)};
  const auto found = untold_directions(all, prior_values(all), measured(all, Eigen::Vector2d(1, 1), 0.01));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].words, "mass and added: only their sum");
}

TEST(Directions, NamesARatio) {
  const std::vector<Parameter> all{uncertain("drag", "", 0.3, 0.03), uncertain("thrust", "N", 20, 2)};
  const auto found =
      untold_directions(all, prior_values(all), measured(all, Eigen::Vector2d(1 / 0.3, -1.0 / 20), 0.001));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].words, "drag and thrust: only their ratio");
}

TEST(Directions, NamesACommonScale) {
  const std::vector<Parameter> all{uncertain("a", "N", 1, 0.1), uncertain("b", "N", 2, 0.2),
                                   uncertain("c", "kg", 3, 0.3)};
  Eigen::MatrixXd covariance = measured(all, Eigen::Vector3d(1, -0.5, 0), 1e-3);
  const Eigen::MatrixXd prior = covariance;
  const Eigen::Vector3d second(1, 0, -1.0 / 3);
  covariance -= prior * second * (prior * second).transpose() / (second.dot(prior * second) + 1e-6);
  const auto found = untold_directions(all, prior_values(all), covariance);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].words, "a, b and c: only their ratios, their common scale is not told");
}

TEST(Directions, NamesWhatIsNotTold) {
  const std::vector<Parameter> all{uncertain("told", "", 1, 1), uncertain("not", "", 1, 1)};
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(2, 2);
  covariance(0, 0) = 0.01;
  const auto found = untold_directions(all, prior_values(all), covariance);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].words, "not: the recordings do not tell it (standard error 1 before, 1 after)");
}

}  // namespace
}  // namespace navcal::identify
