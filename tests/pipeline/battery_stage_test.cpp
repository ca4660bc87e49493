// SPDX-License-Identifier: Apache-2.0
#include "pipeline/battery_stage.h"

#include <gtest/gtest.h>

#include <vector>

namespace navcal::pipeline {
namespace {

struct BatteryLog final : Sink {
  void on_sample(const instruments::Sample&) override {}
  void on_battery(const BatterySample& sample) override { samples.push_back(sample); }
  void on_alarm(const AlarmChange& change) override { alarms.push_back(change); }
  std::vector<BatterySample> samples;
  std::vector<AlarmChange> alarms;
};

class BatteryStageTest : public ::testing::Test {
 protected:
  BatteryStageTest() { settings_.enabled = true; }
  template <class Value>
  void take(BatteryStage& stage, const Value& value, std::uint16_t port = 1) {
    instruments::Sample sample;
    sample.port = port;
    sample.stamp.arrival_ns = sample.stamp.validity_ns = time_ns_ += 100'000'000;
    sample.value = value;
    stage.take(sample, std::nullopt, {}, log_);
  }
  static instruments::MotorSample motor(double current_A) {
    instruments::MotorSample sample;
    sample.current_A = current_A;
    return sample;
  }

  config::BatterySettings settings_;
  BatteryLog log_;
  std::int64_t time_ns_ = 1'000'000'000;
};

TEST_F(BatteryStageTest, IsAbsentUnlessItIsEnabled) {
  config::Settings settings;
  EXPECT_EQ(BatteryStage::make(settings), nullptr);
  settings.battery.enabled = true;
  EXPECT_NE(BatteryStage::make(settings), nullptr);
}

TEST_F(BatteryStageTest, TellsOnceASecondAndNothingBeforeACurrent) {
  BatteryStage stage(settings_);
  for (int i = 0; i < 50; ++i) take(stage, instruments::ImuSample{}, 0);
  EXPECT_TRUE(log_.samples.empty());
  EXPECT_FALSE(stage.newest());
  for (int i = 0; i < 50; ++i) take(stage, motor(1));
  EXPECT_GE(log_.samples.size(), 5U);
  EXPECT_LE(log_.samples.size(), 6U);
  EXPECT_EQ(log_.samples.back().port, 1);
  EXPECT_NEAR(*log_.samples.back().current_A, 1.5, 1e-12);
  EXPECT_FALSE(log_.samples.back().charge);
}

TEST_F(BatteryStageTest, LowChargeRaisesTheAlarmOnceAndChargingClearsIt) {
  BatteryStage stage(settings_);
  take(stage, motor(2));
  stage.set({0.75, 0.01});
  take(stage, motor(2));
  EXPECT_TRUE(log_.alarms.empty());
  stage.set({0.73, 0.01});  // 20 % are 0.74 Ah
  for (int i = 0; i < 30; ++i) take(stage, motor(2));
  ASSERT_EQ(log_.alarms.size(), 1U);
  EXPECT_TRUE(log_.alarms[0].raised);
  EXPECT_EQ(log_.alarms[0].port, 1);
  EXPECT_TRUE(log_.samples.back().low);
  stage.set({0.8, 0.01});  // within the hysteresis
  take(stage, motor(2));
  EXPECT_EQ(log_.alarms.size(), 1U);
  stage.set({3.7, 0.01});
  take(stage, motor(2));
  ASSERT_EQ(log_.alarms.size(), 2U);
  EXPECT_FALSE(log_.alarms[1].raised);
}

TEST_F(BatteryStageTest, AnUnknownChargeRaisesNoAlarm) {
  BatteryStage stage(settings_);
  for (int i = 0; i < 100; ++i) take(stage, motor(5));
  EXPECT_TRUE(log_.alarms.empty());
}

TEST_F(BatteryStageTest, AVoltageThatStaysLowRaisesTheAlarmAfterFiveSeconds) {
  settings_.low_V = 19;
  BatteryStage stage(settings_);
  for (int i = 0; i < 49; ++i) take(stage, instruments::PowerSample{18.5, 2.0});
  EXPECT_TRUE(log_.alarms.empty());
  take(stage, instruments::PowerSample{19.5, 2.0});  // the load was a short one
  for (int i = 0; i < 50; ++i) take(stage, instruments::PowerSample{18.5, 2.0});
  EXPECT_TRUE(log_.alarms.empty());
  for (int i = 0; i < 5; ++i) take(stage, instruments::PowerSample{18.5, 2.0});
  ASSERT_EQ(log_.alarms.size(), 1U);
}

TEST_F(BatteryStageTest, OfTwoGaugesTheFirstCounts) {
  BatteryStage stage(settings_);
  take(stage, instruments::PowerSample{22.0, 1.0}, 2);
  take(stage, instruments::PowerSample{11.0, 9.0}, 3);
  for (int i = 0; i < 20; ++i) take(stage, instruments::ImuSample{}, 0);
  EXPECT_EQ(log_.samples.back().port, 2);
  EXPECT_EQ(log_.samples.back().voltage_V, 22.0);
  EXPECT_EQ(log_.samples.back().current_A, 1.0);
}

}  // namespace
}  // namespace navcal::pipeline
