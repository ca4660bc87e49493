// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

const auto kUnheard = [](double) {};

double error_of(const PredictionErrors::Row& row, Predictor by) {
  return row[static_cast<std::size_t>(by)].value_or(-1);
}

struct Driven {
  config::Layout truth;
  std::vector<RecordedMotion> first, second;
};

Driven driven(std::uint64_t seed) {
  const VehicleCase of = vehicle_case("rov");
  const DrawnVehicle drawn = draw_vehicle(of, seed);
  return {drawn.layout,
          {draw_recording(of, drawn.layout, 90, seed + 1, 0)},
          {draw_recording(of, drawn.layout, 90, seed + 2, 0)}};
}

TEST(VehiclePrediction, TheTrueVehicleIsBestAndAWrongOneIsCalledWorse) {
  const Driven of = driven(3);
  const Prediction truth = predict({of.truth, of.second, of.first, 5}, kUnheard);
  // After 60 s a vehicle without a stable course is elsewhere, its numbers exact or not.
  for (const PredictionErrors& errors : {truth.errors[0], truth.errors[1]}) {
    ASSERT_GT(errors.starts, 0U) << errors.after_s;
    for (const Predictor other : {Predictor::still, Predictor::hold, Predictor::linear})
      EXPECT_LT(error_of(errors.velocity_m_s, Predictor::layout), error_of(errors.velocity_m_s, other))
          << errors.after_s;
  }
  EXPECT_FALSE(truth.worse_than_linear);
  EXPECT_FALSE(truth.worse_than_hold);
  EXPECT_FALSE(truth.by_fixes);
  config::Layout wrong = of.truth;
  for (auto& thruster : wrong.thrusters) thruster.force_scale *= -1;
  const Prediction reversed = predict({wrong, of.second, of.first, 5}, kUnheard);
  EXPECT_TRUE(reversed.worse_than_linear);
  EXPECT_TRUE(reversed.worse_than_hold);
}

// A glider reads its attitude every four seconds, and nothing measures its velocity.
TEST(VehiclePrediction, ReadingsTooFarApartAreSaidToBeSo) {
  Driven of = driven(4);
  of.second.front() = thinned(of.second.front(), 4);
  try {
    (void)predict({of.truth, of.second, {}, 10}, kUnheard);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("0, 0 and 0 % of the time (readings more than 2 s apart"),
              std::string::npos)
        << error.what();
  }
}

TEST(VehiclePrediction, WithoutTrainingThereIsNoRegression) {
  const Driven of = driven(4);
  const Prediction found = predict({of.truth, of.second, {}, 10}, kUnheard);
  EXPECT_FALSE(found.errors[0].position_m[static_cast<std::size_t>(Predictor::linear)]);
  EXPECT_TRUE(found.errors[0].position_m[static_cast<std::size_t>(Predictor::hold)]);
  EXPECT_FALSE(found.worse_than_linear);
}

TEST(VehiclePrediction, WhatIsNotMeasuredIsSaid) {
  Driven of = driven(5);
  RecordedMotion& motion = of.second.front();
  for (const Channel channel : {Channel::bottom_x, Channel::bottom_y, Channel::bottom_z})
    motion.channels[static_cast<std::size_t>(channel)].clear();
  EXPECT_THROW((void)predict({of.truth, of.second, {}, 5}, kUnheard), std::invalid_argument);
  motion.signals.clear();
  EXPECT_THROW((void)predict({of.truth, of.second, {}, 5}, kUnheard), std::invalid_argument);
}

TEST(VehiclePrediction, NoPredictionReachesOverASilence) {
  Driven of = driven(6);
  for (auto& readings : of.second.front().channels)
    std::erase_if(readings, [](const Reading& reading) { return std::fmod(reading.time_s, 20) < 5; });
  const Prediction found = predict({of.truth, of.second, {}, 1}, kUnheard);
  EXPECT_GT(found.errors[1].starts, 0U);
  EXPECT_EQ(found.errors[2].starts, 0U);
}

}  // namespace
}  // namespace navcal::identify
