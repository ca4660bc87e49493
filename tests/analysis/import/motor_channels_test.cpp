// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/motor_channels.h"

#include <gtest/gtest.h>

#include "analysis/import/servo_parameters.h"
#include "config/error.h"
#include "tests/analysis/import/channel_map.h"
#include "tests/analysis/import/recording_sink.h"

namespace navcal::analysis {
namespace {

using testing::RecordingSink;

MotorChannels channels_of(const std::string& toml) {
  return MotorChannels(config::parse_channel_map(toml, "map.toml"));
}

std::string not_found(const MotorChannels& channels) {
  try {
    channels.expect_all_found();
  } catch (const config::Error& error) {
    return error.what();
  }
  return "";
}

TEST(MotorChannels, OneMessageGivesOneSampleForEachInstrument) {
  auto channels = channels_of(
      "[column.\"OUT.a\"]\nmeaning = \"rpm\"\n[column.\"OUT.b\"]\nmeaning = \"motor_current\"\nunit = \"mA\"\n"
      "[column.\"OUT.c\"]\nmeaning = \"fin_2\"\n[column.\"OUT.d\"]\nmeaning = \"rpm\"\ninstance = 2\n");
  EXPECT_TRUE(channels.has("OUT"));
  EXPECT_TRUE(channels.has("OUT", "d"));
  EXPECT_FALSE(channels.has("OUT", "e"));
  EXPECT_FALSE(channels.has("OU"));
  RecordingSink sink;
  const auto read = [](std::string_view member) -> std::optional<double> {
    if (member == "a") return 780;
    if (member == "b") return 1500;
    if (member == "c") return 0.125;
    return NAN;
  };
  EXPECT_TRUE(channels.emit("OUT", read, {"OUT", {}, 5}, sink));
  ASSERT_EQ(sink.samples.size(), 1U) << "the second motor has no number";
  EXPECT_EQ(sink.samples[0].port, "motor");
  EXPECT_EQ(sink.samples[0].message, "OUT by the map");
  EXPECT_EQ(sink.samples[0].time_ns, 5);
  EXPECT_EQ(sink.samples[0].line["rpm"], 780);
  EXPECT_EQ(sink.samples[0].line["current_A"], 1.5);
  EXPECT_EQ(sink.samples[0].line["fins_rad"].dump(), "[null,0.125,null]");
  EXPECT_FALSE(sink.samples[0].line.contains("rpm_commanded"));
  EXPECT_FALSE(channels.emit("IN", read, {"IN", {}, 5}, sink));
}

TEST(MotorChannels, AChannelThatTheLogDoesNotHaveIsNamedByLineAndKey) {
  auto channels = testing::pulses_of("RCOU.C1", "RCOU.C9");
  RecordingSink sink;
  channels.emit(
      "RCOU", [](std::string_view member) { return member == "C1" ? std::optional(1500.0) : std::nullopt; }, {},
      sink);
  EXPECT_EQ(not_found(channels), "map.toml:5: column.RCOU.C9: the log has no value of this channel");
  EXPECT_EQ(not_found(MotorChannels()), "");
  EXPECT_THROW((void)channels_of("[column.C1]\nmeaning = \"rpm\"\n"), config::Error) << "without a message";
}

TEST(MotorChannels, ValuesBeyondTheCurveAreItsEndsAndCounted) {
  auto channels = testing::pulses_of("RCOU.C1", "RCOU.C3");
  RecordingSink sink;
  for (const double pulse_us : {1000.0, 1500.0, 2000.0})
    channels.emit(
        "RCOU", [&](std::string_view member) { return member == "C1" ? pulse_us : 1500.0; }, {}, sink);
  EXPECT_EQ(sink.samples.at(0).line["rpm_commanded"], -1200);
  EXPECT_EQ(sink.samples.at(2).line["rpm_commanded"], 1200);
  ASSERT_EQ(channels.remarks().size(), 1U);
  EXPECT_EQ(channels.remarks()[0], "RCOU.C1: 2 of 3 values lie beyond 1100 to 1900, and count as its ends");
  EXPECT_EQ(not_found(channels), "");
}

TEST(ServoParameters, TellWhatDrivesAnOutput) {
  ServoParameters servos;
  EXPECT_EQ(servos.words(), "");
  servos.take("SERVO1_FUNCTION", 33);
  servos.take("SERVO1_MIN", 1100);
  servos.take("SERVO1_MAX", 1900);
  servos.take("SERVO3_FUNCTION", 21);
  servos.take("SERVO3_REVERSED", 1);
  servos.take("SERVO4_FUNCTION", 0);
  servos.take("SERVO4_MIN", 1100);
  servos.take("SERVO_RATE", 50);
  servos.take("SERVO99_FUNCTION", 33);
  servos.take("PWM_MAIN_FUNC5", 201);
  servos.take("BARO_PRIMARY", 1);
  EXPECT_EQ(
      servos.words(),
      "outputs by the parameters of the vehicle: 1 motor 1 (1100 to 1900 us), 3 rudder (reversed), 5 servo 1");
}

}  // namespace
}  // namespace navcal::analysis
