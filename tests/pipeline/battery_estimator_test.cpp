// SPDX-License-Identifier: Apache-2.0
#include "pipeline/battery_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace navcal::pipeline {
namespace {

constexpr std::int64_t kBatterySecond_ns = 1'000'000'000;

config::BatterySettings thesis_pack() {
  config::BatterySettings options;
  options.curve_V = {18.0, 20.7, 21.5, 21.9, 22.5, 23.2, 24.1, 25.1};
  return options;
}

/// Drives the estimator with one motor current, reading after reading a second apart.
class BatteryEstimatorTest : public ::testing::Test {
 protected:
  void run(double motor_A, int seconds) {
    for (int i = 0; i < seconds; ++i) battery_.motor_current(time_ns_ += kBatterySecond_ns, motor_A);
  }
  void rest(double voltage_V, int seconds) {
    for (int i = 0; i < seconds; ++i) battery_.gauge(time_ns_ += kBatterySecond_ns, 0.5, voltage_V);
  }
  void pass(int seconds) {
    for (int i = 0; i < seconds; ++i) battery_.advance(time_ns_ += kBatterySecond_ns);
  }

  BatteryEstimator battery_{thesis_pack()};
  std::int64_t time_ns_ = kBatterySecond_ns;
};

TEST_F(BatteryEstimatorTest, ChargeIsUnknownUntilItIsSet) {
  run(1, 10);
  EXPECT_FALSE(battery_.charge());
  EXPECT_FALSE(battery_.time_left_s());
  battery_.set({3.7, 0.05});
  ASSERT_TRUE(battery_.charge());
  EXPECT_EQ(battery_.charge()->charge_Ah, 3.7);
}

TEST_F(BatteryEstimatorTest, CountsTheMotorsCurrentAndTheHotelLoad) {
  run(1.5, 1);
  battery_.set({3.7, 0});
  run(1.5, 1800);  // 2 A with the hotel load, half an hour
  EXPECT_NEAR(battery_.charge()->charge_Ah, 2.7, 1e-9);
  EXPECT_NEAR(*battery_.current_A(), 2.0, 1e-12);
  EXPECT_NEAR(*battery_.time_left_s(), 2.7 / 2 * 3600, 1);
  // 5 % of 0.75 Ah and 0.1 A for half an hour.
  EXPECT_NEAR(battery_.charge()->std_Ah, std::hypot(0.05 * 0.75, 0.05), 1e-6);
}

TEST_F(BatteryEstimatorTest, StandardDeviationGrowsWhileNothingCorrects) {
  battery_.set({3.7, 0.01});
  double before_Ah = battery_.charge()->std_Ah;
  for (int i = 0; i < 20; ++i) {
    run(2, 60);
    EXPECT_GT(battery_.charge()->std_Ah, before_Ah);
    before_Ah = battery_.charge()->std_Ah;
  }
}

TEST_F(BatteryEstimatorTest, ChargeIsNeverNegativeNorBeyondTheCapacity) {
  battery_.set({0.1, 0.01});
  run(5, 3600);
  EXPECT_EQ(battery_.charge()->charge_Ah, 0);
  battery_.set({3.6, 0.01});
  for (int i = 0; i < 3600; ++i) battery_.gauge(time_ns_ += kBatterySecond_ns, -5, std::nullopt);
  EXPECT_EQ(battery_.charge()->charge_Ah, 3.7);
  battery_.set({-1, 9});
  EXPECT_EQ(battery_.charge()->charge_Ah, 0);
  battery_.set({99, 9});
  EXPECT_EQ(battery_.charge()->charge_Ah, 3.7);
}

TEST_F(BatteryEstimatorTest, VoltageAfterARestShrinksTheStandardDeviation) {
  battery_.set({3.7, 0.5});
  rest(22.5 - 0.2 * 0.5, 59);  // the gauge rests for less than a minute
  EXPECT_GT(battery_.charge()->std_Ah, 0.45);
  rest(22.5 - 0.2 * 0.5, 30);
  EXPECT_LT(battery_.charge()->std_Ah, 0.3);
  EXPECT_NEAR(battery_.charge()->charge_Ah, 3.7 * 4 / 7, 2 * battery_.charge()->std_Ah);
}

TEST_F(BatteryEstimatorTest, UnknownChargeFollowsFromTheVoltage) {
  for (const double share : {1.0 / 7, 3.0 / 7, 6.0 / 7}) {
    BatteryEstimator battery(thesis_pack());
    const double voltage_V = thesis_pack().curve_V[static_cast<std::size_t>(std::lround(share * 7))] - 0.1;
    for (int i = 1; i < 120; ++i) battery.gauge(i * kBatterySecond_ns, 0.5, voltage_V);
    ASSERT_TRUE(battery.charge());
    EXPECT_NEAR(battery.charge()->charge_Ah, 3.7 * share, 2 * battery.charge()->std_Ah);
    EXPECT_LT(battery.charge()->std_Ah, 0.25 * 3.7);
  }
}

TEST_F(BatteryEstimatorTest, ManyVoltagesAtOneChargeDoNotCountAsMany) {
  battery_.set({2, 1});
  rest(22.4, 120);
  const double soon_Ah = battery_.charge()->std_Ah;
  rest(22.4, 1200);
  EXPECT_GT(battery_.charge()->std_Ah, 0.7 * soon_Ah);
}

TEST_F(BatteryEstimatorTest, VoltageUnderLoadDoesNotCorrect) {
  battery_.set({3.7, 0.5});
  const double before_Ah = battery_.charge()->std_Ah;
  for (int i = 0; i < 300; ++i) battery_.gauge(time_ns_ += kBatterySecond_ns, 3.0, 20.0);
  EXPECT_GE(battery_.charge()->std_Ah, before_Ah);
}

TEST_F(BatteryEstimatorTest, WithoutACurveTheVoltageDoesNotCorrect) {
  config::BatterySettings options = thesis_pack();
  options.curve_V = {};
  battery_ = BatteryEstimator(options);
  battery_.set({3.7, 0.5});
  rest(20, 300);
  EXPECT_NEAR(battery_.charge()->charge_Ah, 3.7 - 0.5 * 299 / 3600, 0.01);
}

TEST_F(BatteryEstimatorTest, WhileTheCurrentIsAwayItsMeanIsCountedAndUncertain) {
  battery_.set({3.7, 0.01});
  run(1.5, 600);
  const auto before = *battery_.charge();
  pass(1800);
  EXPECT_FALSE(battery_.current_A());
  EXPECT_NEAR(battery_.charge()->charge_Ah, before.charge_Ah - 1, 0.02);
  EXPECT_GT(battery_.charge()->std_Ah, before.std_Ah + 0.9);
}

TEST_F(BatteryEstimatorTest, GaugeOfTheWholeCurrentReplacesTheMotors) {
  battery_.set({3.7, 0});
  for (int i = 0; i < 3600; ++i) {
    battery_.gauge(time_ns_ += kBatterySecond_ns, 1.0, std::nullopt);
    battery_.motor_current(time_ns_, 30);
  }
  EXPECT_NEAR(battery_.charge()->charge_Ah, 2.7, 0.01);
  EXPECT_TRUE(battery_.current_is_measured());
}

TEST_F(BatteryEstimatorTest, ValuesThatAreNotANumberAreLeftOut) {
  battery_.set({3, 0.1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  battery_.set({nan, 0.1});
  battery_.set({1, nan});
  run(nan, 10);
  battery_.gauge(time_ns_ += kBatterySecond_ns, nan, nan);
  battery_.speed(time_ns_, nan);
  EXPECT_NEAR(battery_.charge()->charge_Ah, 3, 0.01);
  EXPECT_TRUE(std::isfinite(battery_.charge()->std_Ah));
}

TEST_F(BatteryEstimatorTest, TimesThatGoBackCountNothing) {
  battery_.set({3, 0.1});
  run(2, 10);
  const double before_Ah = battery_.charge()->charge_Ah;
  battery_.motor_current(time_ns_ - 5 * kBatterySecond_ns, 2);
  battery_.advance(0);
  EXPECT_EQ(battery_.charge()->charge_Ah, before_Ah);
}

TEST_F(BatteryEstimatorTest, RangeFollowsFromMeanSpeedAndLoad) {
  battery_.set({2, 0.1});
  run(1.5, 600);
  for (int i = 0; i < 10; ++i) battery_.speed(time_ns_, 1.2);
  EXPECT_NEAR(*battery_.range_left_m(), 1.2 * *battery_.time_left_s(), 1e-6);
}

/// Truths drawn from the stated errors: the stated standard deviation must cover the errors as it says. 200
/// discharges of an hour, rests included; a proportion of 95 % has a standard deviation of 1.5 % then.
TEST(BatteryCoverage, ErrorsLieWithinTwoStatedStandardDeviations) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int kMissions = 200;
  int within = 0;
  double square_Ah2 = 0;
  for (int mission = 0; mission < kMissions; ++mission) {
    config::BatterySettings options = thesis_pack();
    BatteryEstimator battery(options);
    const double scale = 1 + options.current_error * normal(random);
    const double hotel_A = options.hotel_A + options.hotel_error_A * normal(random);
    double truth_Ah = 3.7 - 0.074 * std::abs(normal(random));
    battery.set({3.7, 0.074});
    double motor_A = 0;
    for (int t = 1; t <= 3600; ++t) {
      if (t % 120 == 1) motor_A = uniform(random) < 0.2 ? 0 : 3 * uniform(random);
      truth_Ah -= (motor_A * scale + hotel_A) / 3600;
      battery.motor_current(t * kBatterySecond_ns, motor_A);
    }
    const double error_Ah = battery.charge()->charge_Ah - std::max(0.0, truth_Ah);
    square_Ah2 += error_Ah * error_Ah;
    within += std::abs(error_Ah) <= 2 * battery.charge()->std_Ah ? 1 : 0;
  }
  RecordProperty("within_two_std", within);
  RecordProperty("rms_mAh", static_cast<int>(1000 * std::sqrt(square_Ah2 / kMissions)));
  EXPECT_GE(within, 0.90 * kMissions);
}

}  // namespace
}  // namespace navcal::pipeline
