#include "gap/mission.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>

#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

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

TEST(Mission, KnowsWhenTheFinsWereToldSomethingIfThatWasRecorded) {
  const navcal::test::TemporaryFolder folder;
  const auto file = folder / "mission.cap";
  test::write_mission(file, "identification", "", 60, 1);
  EXPECT_TRUE(load_mission(file, [](double) {}).order_times_s.empty());
  std::ifstream lines(file);
  std::string line, with_orders;
  std::optional<double> first_s;
  std::vector<double> written_s;
  while (std::getline(lines, line)) {
    with_orders += line + "\n";
    if (line.empty() || line[0] == '#') continue;
    const std::string time = line.substr(0, line.find(' '));
    if (!first_s) first_s = std::stod(time.substr(4));
    if (written_s.size() == 3) continue;
    written_s.push_back(std::stod(time.substr(4)) - *first_s);
    with_orders += time + " motor > 244d43432c3638382c2d302e312c302e342c2d302e322a35320d0a\n";  // $MCC,688,...
    with_orders += time + " motor > 244d43430d0a\n";                                            // not an order
  }
  std::ofstream(file) << with_orders;
  const Mission mission = load_mission(file, [](double) {});
  ASSERT_EQ(mission.order_times_s.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(mission.order_times_s[i], written_s[i], 1e-6);
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
