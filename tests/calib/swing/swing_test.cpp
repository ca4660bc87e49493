// SPDX-License-Identifier: Apache-2.0
#include "calib/swing/swing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <string_view>

#include "base/angles.h"
#include "calib/correction.h"

namespace navcal::calib {
namespace {

/// The first and last moments of a turn still are within the band of the rest.
constexpr double kSmall_rad = 5e-5;
const Swing::Coefficients kTrue = Swing::Coefficients(3, 5, -5, 2, 2) * base::kRadiansPerDegree;

double deviation(double psi, const Swing::Coefficients& c = kTrue) {
  return c[0] + c[1] * std::sin(psi) + c[2] * std::cos(psi) + c[3] * std::sin(2 * psi) + c[4] * std::cos(2 * psi);
}

/// Rests at the measured heading for so long, then turns on within `turn_s`.
struct Helmsman {
  Swing& swing;
  double time_s = 100;
  double noise_rad = 0;
  Swing::Coefficients truth = kTrue;
  std::mt19937_64 random{1};

  void rest(double measured_rad, double duration_s, double reference_error_rad = 0) {
    std::normal_distribution<double> normal;
    for (const double end_s = time_s + duration_s; time_s < end_s; time_s += 0.1) {
      const double measured = measured_rad + noise_rad * normal(random);
      swing.update(time_s, measured, measured_rad - deviation(measured_rad, truth) + reference_error_rad);
    }
  }
  void turn(double from_rad, double to_rad, double duration_s = 8) {
    for (double share = 0; share < 1; share += 0.1 / duration_s, time_s += 0.1) {
      const double measured = from_rad + share * (to_rad - from_rad);
      swing.update(time_s, measured, measured - deviation(measured, truth));
    }
  }
  void whole_swing(double off_nominal_rad = 0) {
    for (int i = 0; i < 8; ++i) {
      const double heading = 45 * base::kRadiansPerDegree * i + off_nominal_rad;
      rest(heading, 15);
      turn(heading, heading + 45 * base::kRadiansPerDegree);
    }
  }
};

TEST(Swing, TableAndCoefficientsOfAWholeSwing) {
  for (const double off_deg : {0.0, 4.0, -6.0}) {
    Swing swing;
    Helmsman{swing}.whole_swing(off_deg * base::kRadiansPerDegree);
    ASSERT_EQ(swing.missing(), 0U);
    const auto estimate = swing.estimate();
    ASSERT_TRUE(estimate);
    EXPECT_LT((estimate->deviation - kTrue).cwiseAbs().maxCoeff(), kSmall_rad);
    EXPECT_LT(estimate->residual_rad, kSmall_rad);
    const auto table = swing.table_rad();
    for (std::size_t i = 0; i < 8; ++i)
      EXPECT_NEAR((*table)[i], deviation(45 * base::kRadiansPerDegree * static_cast<double>(i)), kSmall_rad) << i;
    EXPECT_TRUE(swing.judgement().accepted);
  }
}

TEST(Swing, TheTableIsPeriodicAndLinearBetween) {
  Swing swing;
  Helmsman{swing}.whole_swing();
  const SwingCorrection correct{*swing.table_rad()};
  const auto deviation_at = [&](double heading) { return heading - correct(heading); };
  for (double heading = -10; heading < 10; heading += 0.1) {
    EXPECT_NEAR(deviation_at(heading), deviation_at(heading + 2 * std::numbers::pi), 1e-12);
  }
  const double middle = (deviation(315 * base::kRadiansPerDegree) + deviation(0)) / 2;
  EXPECT_NEAR(deviation_at(337.5 * base::kRadiansPerDegree), middle, kSmall_rad);
}

TEST(Swing, StandardErrorsAreHonest) {
  int within = 0, all = 0;
  for (unsigned run = 1; run <= 60; ++run) {
    Swing swing;
    Helmsman helmsman{swing};
    helmsman.noise_rad = 0.004;
    helmsman.random.seed(run);
    std::normal_distribution<double> normal(0, 0.01);
    for (int i = 0; i < 8; ++i) {
      helmsman.rest(45 * base::kRadiansPerDegree * i, 12, normal(helmsman.random));
      helmsman.turn(45 * base::kRadiansPerDegree * i, 45 * base::kRadiansPerDegree * (i + 1));
    }
    const auto estimate = swing.estimate();
    ASSERT_TRUE(estimate);
    for (int k = 0; k < 5; ++k, ++all)
      within += std::abs(estimate->deviation[k] - kTrue[k]) <= 2 * std::sqrt(estimate->covariance(k, k)) ? 1 : 0;
  }
  EXPECT_GE(within, 0.91 * all);  // 95.4 % of 300: 99.9 % binomial limits
  EXPECT_LE(within, 0.987 * all);
}

TEST(Swing, SaysWhichHeadingsAreMissing) {
  Swing swing;
  Helmsman helmsman{swing};
  for (const int heading : {0, 45, 135, 180, 270}) {
    helmsman.rest(heading * base::kRadiansPerDegree, 15);
    helmsman.turn(heading * base::kRadiansPerDegree, (heading + 45) * base::kRadiansPerDegree);
  }
  EXPECT_EQ(swing.missing(), 3U);
  EXPECT_FALSE(swing.table_rad());
  EXPECT_TRUE(swing.estimate());  // five headings determine five coefficients
  const Judgement judgement = swing.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_EQ(judgement.manoeuvre, "rest 10 s on each of the headings 90, 225, 315");
  EXPECT_DOUBLE_EQ(judgement.coverage, 5.0 / 8);
}

TEST(Swing, ShortRestsTurnsAndRestsBetweenHeadingsDoNotCount) {
  Swing swing;
  Helmsman helmsman{swing};
  helmsman.rest(0, 7);
  helmsman.turn(0, 20 * base::kRadiansPerDegree);
  helmsman.rest(22 * base::kRadiansPerDegree, 60);
  for (int turns = 0; turns < 5; ++turns) helmsman.turn(0, 360 * base::kRadiansPerDegree, 60);
  EXPECT_EQ(swing.missing(), 8U);
  EXPECT_FALSE(swing.estimate());
}

TEST(Swing, ARestCountsWhileItLasts) {
  Swing swing;
  Helmsman helmsman{swing};
  helmsman.rest(90 * base::kRadiansPerDegree, 4.05);
  EXPECT_EQ(swing.headings()[2].rests, 0U);
  helmsman.rest(90 * base::kRadiansPerDegree, 8);
  EXPECT_EQ(swing.headings()[2].rests, 1U);
  EXPECT_NEAR(swing.headings()[2].deviation_rad, deviation(90 * base::kRadiansPerDegree), 1e-12);
}

TEST(Swing, SeveralRestsOnAHeadingAreAveraged) {
  Swing swing;
  Helmsman helmsman{swing};
  for (const double error : {0.02, -0.02}) {
    helmsman.rest(180 * base::kRadiansPerDegree, 12, error);
    helmsman.turn(180 * base::kRadiansPerDegree, 200 * base::kRadiansPerDegree);
    helmsman.turn(200 * base::kRadiansPerDegree, 180 * base::kRadiansPerDegree);
  }
  const auto heading = swing.headings()[4];
  EXPECT_EQ(heading.rests, 2U);
  EXPECT_NEAR(heading.deviation_rad, deviation(180 * base::kRadiansPerDegree), kSmall_rad);
  EXPECT_NEAR(heading.std_rad, 0.01 / std::sqrt(2.0), 1e-4);
}

TEST(Swing, ACompassMountedBackwardsIsNotTornByTheSeam) {
  Swing swing;
  Helmsman helmsman{swing};
  helmsman.truth[0] = 179.5 * base::kRadiansPerDegree;
  helmsman.whole_swing();
  EXPECT_NEAR(
      std::remainder(swing.estimate()->deviation[0] - 179.5 * base::kRadiansPerDegree, 2 * std::numbers::pi), 0,
      kSmall_rad);
  EXPECT_NEAR(swing.estimate()->deviation[1], 5 * base::kRadiansPerDegree, kSmall_rad);
}

TEST(Swing, GapsNotANumberAndReversedStampsDoNotSpoilIt) {
  Swing swing;
  Helmsman helmsman{swing};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 8; ++i) {
    helmsman.rest(45 * base::kRadiansPerDegree * i, 6);
    swing.update(nan, 1, 1);
    swing.update(helmsman.time_s, nan, 1);
    swing.update(helmsman.time_s, 1, -std::numeric_limits<double>::infinity());
    swing.update(helmsman.time_s - 5, 45 * base::kRadiansPerDegree * i, 0);
    helmsman.rest(45 * base::kRadiansPerDegree * i, 8);
    helmsman.turn(45 * base::kRadiansPerDegree * i, 45 * base::kRadiansPerDegree * (i + 1));
  }
  EXPECT_LT((swing.estimate()->deviation - kTrue).cwiseAbs().maxCoeff(), kSmall_rad);
  Swing torn;
  Helmsman sleeper{torn};
  sleeper.rest(0, 6);
  sleeper.time_s += 5;
  sleeper.rest(0, 6);
  EXPECT_EQ(torn.missing(), 8U) << "two halves of a rest, and nothing known between them";
}

TEST(Swing, SavedAndRestoredItGoesOnBitForBit) {
  const auto saved = [](Swing& swing) {
    Archive archive;
    swing.archive(archive);
    return archive.bytes();
  };
  Swing whole, first;
  Helmsman one{whole}, other{first};
  one.noise_rad = other.noise_rad = 0.004;
  one.rest(0, 30);
  one.turn(0, 0.8);
  other.rest(0, 30);
  const std::string bytes = saved(first);
  Swing second;
  Archive restoring{std::string_view(bytes)};
  second.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  Helmsman{second, other.time_s}.turn(0, 0.8);
  EXPECT_EQ(saved(second), saved(whole));
}

}  // namespace
}  // namespace navcal::calib
