// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/sources.h"

#include <gtest/gtest.h>

namespace navcal::gap {
namespace {

Diagnosis with_source(double gain_nats, const std::string& channel) {
  Diagnosis answer;
  answer.where = {{"imu.gyro", "fast", 2, 1, "deg/s", 1e-9},
                  {"compass.tilt", "turn_rate", 1, 0.1, "deg", 1e-12},
                  {"imu.gyro", "slow", 1.5, 1, "deg/s", 1e-6},
                  {"compass.tilt", "roll", 0.9, 0.1, "deg", 1e-10}};
  answer.sources = {{"compass.tilt",
                     "the inclinometer",
                     gain_nats,
                     {{"roll", channel, "turn_rate", "yaw_rate", {"rate"}, -0.4, 0.01, "deg"}}}};
  return answer;
}

std::vector<std::string> cells(const Diagnosis& answer) {
  std::vector<std::string> all;
  for (const WhereEntry& entry : answer.where) all.push_back(entry.channel + ' ' + entry.regime);
  return all;
}

TEST(PutSourceFirst, KeepsTheOrderWithinTheChannelAndOfTheOthers) {
  Diagnosis answer = with_source(50, "compass.tilt");
  put_source_first(answer);
  EXPECT_EQ(cells(answer), (std::vector<std::string>{"compass.tilt turn_rate", "compass.tilt roll",
                                                     "imu.gyro fast", "imu.gyro slow"}));
}

TEST(PutSourceFirst, AnErrorWhoseChannelShowsNothingBecomesAnEntry) {
  Diagnosis answer = with_source(50, "imu.accel");
  put_source_first(answer);
  ASSERT_EQ(answer.where.size(), 5U);
  EXPECT_EQ(answer.where[0].channel, "imu.accel");
  EXPECT_EQ(answer.where[0].regime, "turn_rate");
  EXPECT_EQ(answer.where[0].gap, 0.4);
  EXPECT_EQ(answer.where[0].floor, 0.01);
  EXPECT_GT(answer.where[0].p_value, 0);
  EXPECT_LT(answer.where[0].p_value, 1e-20);
}

TEST(PutSourceFirst, ChangesNothingWithoutAClearSourceOrAChannel) {
  for (const auto& [gain_nats, channel] : {std::pair{5.0, "compass.tilt"}, std::pair{50.0, ""}}) {
    Diagnosis answer = with_source(gain_nats, channel);
    put_source_first(answer);
    EXPECT_EQ(cells(answer).front(), "imu.gyro fast");
    EXPECT_EQ(answer.where.size(), 4U);
  }
  Diagnosis nothing;
  put_source_first(nothing);
  EXPECT_TRUE(nothing.where.empty());
}

}  // namespace
}  // namespace navcal::gap
