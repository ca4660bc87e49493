// SPDX-License-Identifier: Apache-2.0
#include "daemon/state_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "daemon/state_collector.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

std::string state_line(const VehicleState& state) {
  std::string line;
  append_state(line, state);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  return line;
}

TEST(StateReport, WhatIsNotKnownIsNullAndEveryKeyIsThere) {
  const json state = json::parse(state_line({}));
  EXPECT_EQ(state,
            json::parse(R"({"class":"STATE","time":null,"time_std":null,"north":"magnetic","heading_rad":null,
      "pitch_rad":null,"roll_rad":null,"rate_rad_s":null,"depth_m":null,"lat":null,"lon":null,"position_std_m":null,
      "speed_m_s":null,"climb_m_s":null,"shaft_rpm":null,"fins_deg":[null,null,null],
      "std":{"heading_rad":null,"pitch_rad":null,"depth_m":null,"speed_m_s":null},
      "age_s":{"compass":null,"imu":null,"gps":null,"motor":null},"alarms":[],
      "motor":{"holder":null,"priority":null,"expires_in_s":null},"order":{"sequence":null,"late_s":null},
      "altitude_m":null,"altitude_std_m":null,
      "battery":{"voltage_V":null,"charge_Ah":null,"charge_std_Ah":null}})"));
}

TEST(StateReport, WhatIsKnownIsSaidInTheUnitsOfTheContract) {
  VehicleState state;
  state.time_utc_ns = 1'700'000'000'125'000'001;
  state.is_north_true = true;
  state.heading_rad = 1.5;
  state.rate_rad_s = {0.1, -0.2, 0.3};
  state.latitude_rad = 0.5;
  state.fins_deg = {0, std::nullopt, -5.25};
  state.alarms = {"leak_forward", "command_not_echoed"};
  state.holder = "a \"pilot\"";
  state.priority = 2;
  state.expires_in_s = 0.25;
  state.order_sequence = 7;
  const std::string line = state_line(state);
  EXPECT_NE(line.find("\"time\":1700000000.125000001,"), std::string::npos) << line;
  const json said = json::parse(line);
  EXPECT_EQ(said["north"], "true");
  EXPECT_EQ(said["rate_rad_s"], json::parse("[0.1,-0.2,0.3]"));
  EXPECT_NEAR(said["lat"].get<double>(), 28.647889757, 1e-9);
  EXPECT_EQ(said["fins_deg"], json::parse("[0,null,-5.25]"));
  EXPECT_EQ(said["alarms"], json::parse(R"(["leak forward","command not echoed"])"));
  EXPECT_EQ(said["motor"], json::parse(R"({"holder":"a \"pilot\"","priority":2,"expires_in_s":0.25})"));
  EXPECT_EQ(said["order"], json::parse(R"({"sequence":7,"late_s":null})"));
}

TEST(StateReport, WhatIsNoNumberIsNull) {
  VehicleState state;
  state.heading_rad = std::numeric_limits<double>::quiet_NaN();
  state.depth_m = std::numeric_limits<double>::infinity();
  const json said = json::parse(state_line(state));
  EXPECT_TRUE(said["heading_rad"].is_null());
  EXPECT_TRUE(said["depth_m"].is_null());
}

TEST(Spread, SaysNothingBeforeTenReadingsAndForgets) {
  Spread spread;
  for (int i = 0; i < 9; ++i) spread.add(2);
  EXPECT_FALSE(spread.std());
  spread.add(-2);
  EXPECT_NEAR(*spread.std(), 2, 1e-12);
  for (int i = 0; i < 1000; ++i) spread.add(i % 2 == 0 ? 1 : -1);
  EXPECT_NEAR(*spread.std(), 1, 1e-3);
}

TEST(StateCollector, DepthIsThatOfTheOriginAlsoWithoutAnEstimate) {
  config::Settings settings;
  settings.calibration.enabled = settings.navigation.enabled = false;
  settings.ports.emplace_back().protocol = protocols::Protocol::imu_card;
  settings.ports[0].mounting.position_m = {1, 0, 0.3};
  const pipeline::Pipeline pipeline(settings);
  StateCollector collector(settings, pipeline);
  instruments::Sample sample;
  instruments::ImuSample card;
  card.depth_m = 2;
  sample.value = card;
  collector.take(sample);
  EXPECT_NEAR(collector.at(0).depth_m.value(), 1.7, 1e-12);
  EXPECT_NEAR(collector.at(0).depth_m.value(), 1.7, 1e-12) << "asking does not change it";
}

TEST(StateCollector, TheHeadingStaysWhileTheFieldOfTheSameDeviceComes) {
  config::Settings settings;
  settings.calibration.enabled = settings.navigation.enabled = false;
  settings.ports.emplace_back().protocol = protocols::Protocol::mavlink;
  const pipeline::Pipeline pipeline(settings);
  StateCollector collector(settings, pipeline);
  instruments::Sample sample;
  instruments::CompassSample attitude, field;
  attitude.heading_rad = 1;
  attitude.heading_is_true = true;
  field.field_body_uT = instruments::Vector3{20, 0, 40};
  EXPECT_EQ(collector.heading_source(), "");
  for (const auto& compass : {field, attitude, field}) {
    sample.value = compass;
    collector.take(sample);
  }
  EXPECT_EQ(collector.at(0).heading_rad, 1);
  EXPECT_EQ(collector.heading_source(), "autopilot");
  EXPECT_TRUE(collector.at(0).is_north_true);
  EXPECT_FALSE(collector.is_serving_compass(sample)) << "a field alone is no heading";
  field.heading_calibrated_rad = 2;
  sample.value = field;
  collector.take(sample);
  EXPECT_TRUE(collector.is_serving_compass(sample));
  EXPECT_EQ(collector.at(0).heading_rad, 2);
  EXPECT_EQ(collector.heading_source(), "calibration");
}

}  // namespace
}  // namespace navcal::daemon
