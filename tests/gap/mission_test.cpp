#include "gap/mission.h"

#include <gtest/gtest.h>

#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

using test::simulated_mission;

TEST(Mission, IsReadWhole) {
  const Mission mission = simulated_mission("identification", "", 60, 1);
  EXPECT_EQ(mission.shortcoming(), "");
  EXPECT_NEAR(static_cast<double>(mission.card.size()), 1200, 3);
  EXPECT_NEAR(static_cast<double>(mission.compass.size()), 600, 3);
  EXPECT_NEAR(static_cast<double>(mission.motor.size()), 600, 3);
  for (std::size_t i = 1; i < mission.card.size(); ++i)
    EXPECT_LT(mission.card[i - 1].time_s, mission.card[i].time_s);
  for (std::size_t i = 1; i < mission.fixes.size(); ++i) {
    const bool same_sight = mission.fixes[i].time_s - mission.fixes[i - 1].time_s < 2;
    EXPECT_EQ(mission.fixes[i].number, same_sight ? mission.fixes[i - 1].number + 1 : 0);
  }
}

TEST(Mission, SaysWhatItLacks) {
  const Mission whole = simulated_mission("identification", "", 60, 1);
  Mission mission = whole;
  mission.card.clear();
  EXPECT_NE(mission.shortcoming().find("inertial card"), std::string::npos);
  mission = whole;
  mission.compass.clear();
  EXPECT_NE(mission.shortcoming().find("compass"), std::string::npos);
  mission = whole;
  mission.motor.clear();
  EXPECT_NE(mission.shortcoming().find("motor card"), std::string::npos);
  EXPECT_NE(simulated_mission("identification", "", 10, 1).shortcoming().find("lasts 9."), std::string::npos);
  EXPECT_NE(Mission{}.shortcoming(), "");
}

}  // namespace
}  // namespace navcal::gap
