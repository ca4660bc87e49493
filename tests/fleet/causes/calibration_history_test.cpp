// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/calibration_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace navcal::fleet {
namespace {

CalibrationHistory series(unsigned seed, std::size_t count, double std, double scatter,
                          const std::function<double(std::size_t)>& truth) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  CalibrationHistory history;
  for (std::size_t i = 0; i < count; ++i) {
    history.points.push_back({std::to_string(i), "", static_cast<std::int64_t>(i) * 86'400'000'000'000,
                              truth(i) + std * normal(random) + scatter * normal(random), std});
  }
  judge_course(history);
  return history;
}

TEST(CalibrationHistory, CallsEqualValuesConstantInMostSeries) {
  int constant = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    constant +=
        series(seed, 12, 0.1, 0, [](std::size_t) { return 3.0; }).course == CalibrationCourse::constant ? 1 : 0;
  }
  EXPECT_GE(constant, 194);
}

TEST(CalibrationHistory, FindsADriftWithItsError) {
  const auto history = series(1, 20, 0.1, 0, [](std::size_t day) { return 1 + 0.05 * static_cast<double>(day); });
  EXPECT_EQ(history.course, CalibrationCourse::drift);
  EXPECT_NEAR(history.drift_per_day, 0.05, 3 * history.drift_std);
}

TEST(CalibrationHistory, FindsTheMissionOfAStep) {
  const auto history = series(2, 15, 0.1, 0, [](std::size_t day) { return day >= 9 ? 2.0 : 1.0; });
  EXPECT_EQ(history.course, CalibrationCourse::step);
  EXPECT_EQ(history.step_at, 9U);
  EXPECT_NEAR(history.step, 1, 3 * history.step_std);
}

TEST(CalibrationHistory, DoesNotMakeACourseOfErrorsThatAreStatedTooSmall) {
  const auto history = series(3, 15, 0.01, 0.5, [](std::size_t) { return 1.0; });
  EXPECT_EQ(history.course, CalibrationCourse::scatter);
  EXPECT_NEAR(history.excess_std, 0.5, 0.25);
}

TEST(CalibrationHistory, SaysNothingOfTwoValues) {
  EXPECT_EQ(series(4, 2, 0.1, 0, [](std::size_t i) { return static_cast<double>(i) * 9; }).course,
            CalibrationCourse::too_few);
}

TEST(CalibrationHistory, SortsByTime) {
  CalibrationHistory history;
  for (const int day : {3, 1, 0, 2}) {
    history.points.push_back({"", "", day * 86'400'000'000'000, day >= 2 ? 5.0 : 0.0, 0.1});
  }
  judge_course(history);
  EXPECT_EQ(history.course, CalibrationCourse::step);
  EXPECT_EQ(history.step_at, 2U);
}

}  // namespace
}  // namespace navcal::fleet
