// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "nav/dead_reckoning.h"

namespace navcal::nav::test {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

TEST(ErrorRadius, OfALineAndOfACircle) {
  EXPECT_EQ(radius_95_m(Matrix2d::Zero()), 0);
  EXPECT_NEAR(radius_95_m(Vector2d(9, 0).asDiagonal()), 3 * 1.9600, 0.01);
  EXPECT_NEAR(radius_95_m(4 * Matrix2d::Identity()), 2 * std::sqrt(-2 * std::log(0.05)), 0.02);
}

TEST(ErrorRadius, ContainsNineteenOfTwenty) {
  std::mt19937_64 random(2611);
  std::normal_distribution<double> normal;
  for (const double share : {0.1, 0.3, 0.5, 0.8}) {
    const Eigen::Rotation2Dd turn(0.7);
    const Matrix2d covariance =
        turn.toRotationMatrix() * Vector2d(1, share * share).asDiagonal() * turn.toRotationMatrix().transpose();
    const Matrix2d root = covariance.llt().matrixL();
    const double radius = radius_95_m(covariance);
    constexpr int kDraws = 40'000;
    int inside = 0;
    for (int i = 0; i < kDraws; ++i) inside += (root * Vector2d(normal(random), normal(random))).norm() <= radius;
    EXPECT_NEAR(static_cast<double>(inside) / kDraws, 0.95, 0.005) << share;  // five standard errors
  }
}

Way way_east(double duration_s) {
  Way way;
  way.duration_s = duration_s;
  way.speed_m_s = 0.8;
  way.ahead = {0.6, 0.8};
  way.heading_std_rad = 0.05;
  way.speed_known = way.heading_known = true;
  return way;
}

TEST(DeadReckoning, PredictsTheErrorsThatItStatesLater) {
  for (const bool heading_known : {true, false}) {
    for (const bool speed_known : {true, false}) {
      ReckoningOptions options;
      options.set_time_s = 300;  // so that the set is partly forgotten within the prediction
      DeadReckoning reckoning(options);
      reckoning.fix({0, {0, 0}, 1, {}, 0.1}, Vector2d::Zero(), 0);
      Way way = way_east(0.05);
      for (int i = 0; i < 200; ++i) reckoning.advance(way);
      way.heading_known = heading_known;
      way.speed_known = speed_known;
      reckoning.advance(way);
      EXPECT_LT((reckoning.covariance_m2(0).diagonal() - Vector2d(reckoning.std_m().cwiseAbs2())).norm(), 1e-9);
      const Matrix2d predicted = reckoning.covariance_m2(400);
      for (int i = 0; i < 8000; ++i) reckoning.advance(way);
      const Vector2d stated = reckoning.std_m();
      EXPECT_NEAR(std::sqrt(predicted(0, 0)), stated.x(), 1e-3 * stated.x());
      EXPECT_NEAR(std::sqrt(predicted(1, 1)), stated.y(), 1e-3 * stated.y());
    }
  }
}

}  // namespace
}  // namespace navcal::nav::test
