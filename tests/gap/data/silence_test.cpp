// SPDX-License-Identifier: Apache-2.0
#include "gap/data/silence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gap/data/mission.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

using test::simulated_mission;
using Names = std::vector<std::string>;

std::vector<double> every(double step_s, double from_s, double until_s) {
  std::vector<double> times_s;
  for (double time_s = from_s; time_s < until_s; time_s += step_s) times_s.push_back(time_s);
  return times_s;
}

TEST(Silence, OfAQuantityIsWhatIsLongBetweenItsReadings) {
  EXPECT_TRUE(silences_of(Quantity::depth, every(1, 0, 100), 100).empty());
  EXPECT_TRUE(silences_of(Quantity::depth, every(kSilent_s, 0, 300), 300).empty());
  const auto none = silences_of(Quantity::depth, {}, 100);
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none.front(), (Silence{Quantity::depth, 0, 100}));
  auto times_s = every(1, 50, 100);
  for (const double time_s : every(1, 200, 251)) times_s.push_back(time_s);
  const auto three = silences_of(Quantity::depth, times_s, 300);
  ASSERT_EQ(three.size(), 3U);
  EXPECT_EQ(three[0].until_s, 50) << "it begins late";
  EXPECT_NEAR(three[1].from_s, 99, 1e-9);
  EXPECT_GT(three[1].from_s, 99) << "its last reading is none of it";
  EXPECT_EQ(three[1].until_s, 200);
  EXPECT_EQ(three[2].until_s, 300) << "it stops";
}

TEST(Silence, AMissionWithAllInstrumentsHasNoneAndIsNotChanged) {
  const Mission whole = simulated_mission("identification", "", 80, 1);
  EXPECT_TRUE(whole.silences.empty());
  EXPECT_TRUE(silence_key(whole).empty());
  EXPECT_TRUE(missing_instruments(whole).empty());
  Mission again = whole;
  find_silences(again);
  leave_out({}, again);
  Mission simulated = whole;
  silence_like(whole, simulated);
  for (const Mission* other : {&again, &simulated}) {
    ASSERT_EQ(other->card.size(), whole.card.size());
    ASSERT_EQ(other->compass.size(), whole.compass.size());
    EXPECT_EQ(other->duration_s, whole.duration_s);
    for (std::size_t i = 0; i < whole.card.size(); ++i) {
      EXPECT_EQ(other->card[i].time_s, whole.card[i].time_s);
      EXPECT_EQ(other->card[i].gyro_rad_s, whole.card[i].gyro_rad_s);
    }
  }
}

TEST(Silence, WhatIsLeftOutIsMissingByItsName) {
  const Mission whole = simulated_mission("identification", "", 80, 1);
  const auto missing = [&](const char* name) {
    Mission mission = whole;
    leave_out(quantities_named(name), mission);
    EXPECT_NE(silence_key(mission), "");
    return missing_instruments(mission);
  };
  EXPECT_EQ(missing("compass"), Names{"compass"});
  EXPECT_EQ(missing("field"), Names{"magnetometer"});
  EXPECT_EQ(missing("tilt"), Names{"inclinometer"});
  EXPECT_EQ(missing("card"), Names{"inertial card"});
  EXPECT_EQ(missing("gyros"), Names{"rate gyros"});
  EXPECT_EQ(missing("accelerometers"), Names{"accelerometers"});
  EXPECT_EQ(missing("depth"), Names{"depth"});
  EXPECT_EQ(missing("gps"), Names{"GPS"});
  EXPECT_EQ(missing("motor"), Names{"motor report"});
  EXPECT_THROW((void)quantities_named("sonar"), std::invalid_argument);
}

TEST(Silence, FramesWithoutValuesTakeThePlaceOfASilentCard) {
  const Mission whole = simulated_mission("identification", "", 80, 1);
  Mission mission = whole;
  mission.card.clear();
  find_silences(mission);
  EXPECT_NEAR(static_cast<double>(mission.card.size()), static_cast<double>(whole.card.size()), 30);
  for (const CardReading& reading : mission.card) EXPECT_TRUE(std::isnan(reading.gyro_rad_s[0]));
  find_silences(mission);
  EXPECT_NEAR(static_cast<double>(mission.card.size()), static_cast<double>(whole.card.size()), 30) << "once";
}

TEST(Silence, ForAWhileIsToldWithItsTimesAndTakenFromSimulatedMissions) {
  const Mission whole = simulated_mission("identification", "", 160, 1);
  Mission mission = whole;
  std::erase_if(mission.compass, [](const CompassReading& r) { return r.time_s > 50 && r.time_s < 100; });
  std::erase_if(mission.card, [](const CardReading& r) { return r.time_s > 120; });
  find_silences(mission);
  EXPECT_TRUE(missing_instruments(mission).empty());
  const auto pauses = interruptions(mission);
  ASSERT_EQ(pauses.size(), 2U);
  EXPECT_EQ(pauses[0].what, "compass");
  EXPECT_NEAR(pauses[0].from_s, 50, 0.2);
  EXPECT_NEAR(pauses[0].until_s, 100, 0.2);
  EXPECT_EQ(pauses[1].what, "inertial card");
  EXPECT_TRUE(mission.is_silent(Quantity::tilt, 70));
  EXPECT_FALSE(mission.is_silent(Quantity::tilt, 110));

  Mission simulated = whole;
  silence_like(mission, simulated);
  for (const CompassReading& reading : simulated.compass) {
    EXPECT_TRUE(reading.time_s < 51 || reading.time_s > 99) << reading.time_s;
  }
  const auto speaks = [](const CardReading& r) { return r.time_s > 121 && std::isfinite(r.depth_m); };
  EXPECT_TRUE(std::none_of(simulated.card.begin(), simulated.card.end(), speaks));
  EXPECT_NEAR(simulated.card.back().time_s, whole.card.back().time_s, 1);
}

TEST(Silence, OfTheMotorCardLeavesTheLongestTimeToJudge) {
  Mission mission = simulated_mission("identification", "", 200, 1);
  std::erase_if(mission.motor, [](const MotorReading& r) { return r.time_s > 60 && r.time_s < 100; });
  find_silences(mission);
  EXPECT_NEAR(mission.judged_from_s, 100, 0.2);
  EXPECT_NEAR(mission.judged_until_s, 200, 0.2);
  EXPECT_EQ(mission.shortcoming(), "");
  std::erase_if(mission.motor, [](const MotorReading& r) { return r.time_s > 120; });
  find_silences(mission);
  EXPECT_NEAR(mission.judged_until_s, 60, 0.5);
  std::erase_if(mission.motor, [](const MotorReading& r) { return r.time_s > 20; });
  find_silences(mission);
  EXPECT_NE(mission.shortcoming().find("the motor card reports for 2"), std::string::npos)
      << mission.shortcoming();
}

}  // namespace
}  // namespace navcal::gap
