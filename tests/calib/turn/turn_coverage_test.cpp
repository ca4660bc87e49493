// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "calib/thesis/turn_problem.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib {
namespace {

using namespace test;
using thesis::filtered;

TEST(TurnCoverage, WithoutNoiseTheGoalsOfTheGyroOnEveryPath) {
  for (int p = 1; p <= 8; ++p) {
    Random random(1);
    const auto readings = measure(load_true_path("path" + std::to_string(p)), Deviation::Zero(), kNoNoise, random);
    const TurnCoefficients found = filtered(readings, TurnPrior::unknown_gyro()).estimate();
    EXPECT_NEAR(found[kScale] / kTrueScale, 1, 0.005 / 100) << p;
    EXPECT_NEAR(found[kBias] / kTrueBias_rad_s, 1, 0.02 / 100) << p;
  }
}

TEST(TurnCoverage, TwoStandardErrorsCoverTheTruthOnFullAndHalfCircles) {
  TurnCoefficients truth;
  truth << kTrueScale, kTrueBias_rad_s, thesis_deviation().tail<4>();
  constexpr int kRuns = 25;
  int covered = 0;
  for (const char* name : {"path2", "path4"}) {
    const auto path = load_true_path(name);
    Random random(11);
    for (int run = 0; run < kRuns; ++run) {
      const TurnFilter filter =
          filtered(measure(path, thesis_deviation(), Noise{}, random), TurnPrior::unknown_both());
      const TurnCovariance covariance = filter.covariance();
      for (int i = 0; i < 6; ++i) {
        if (std::abs(filter.estimate()[i] - truth[i]) < 2 * std::sqrt(covariance(i, i))) ++covered;
      }
    }
  }
  // The sample is 300, but errors of one run are correlated: the limits are those of fifty.
  EXPECT_GT(covered, 300 * 0.82);
}

}  // namespace
}  // namespace navcal::calib
