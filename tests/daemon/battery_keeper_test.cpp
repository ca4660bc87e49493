// SPDX-License-Identifier: Apache-2.0
#include "daemon/battery_keeper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace navcal::daemon {
namespace {

class BatteryKeeperTest : public testing::Test {
 protected:
  BatteryKeeperTest() {
    settings_.log.directory = folder_ / "logs";
    settings_.battery.enabled = true;
  }
  void keep(double charge_Ah, double std_Ah) const {
    BatteryKeeper keeper(settings_);
    pipeline::BatterySample sample;
    sample.charge = pipeline::BatteryCharge{charge_Ah, std_Ah};
    keeper.take(sample);
    keeper.stop();
  }

  test::TemporaryFolder folder_;
  config::Settings settings_;
};

TEST_F(BatteryKeeperTest, NothingIsKeptBeforeTheFirstCharge) {
  BatteryKeeper keeper(settings_);
  EXPECT_FALSE(keeper.load());
  keeper.take({});
  keeper.stop();
  EXPECT_FALSE(std::filesystem::exists(settings_.log.directory / "battery.state"));
}

TEST_F(BatteryKeeperTest, TheNextRunContinuesWithMoreUncertainty) {
  keep(2.5, 0.1);
  const auto charge = BatteryKeeper(settings_).load();
  ASSERT_TRUE(charge);
  EXPECT_EQ(charge->charge_Ah, 2.5);
  EXPECT_NEAR(charge->std_Ah, std::hypot(0.1, 0.02 * 3.7), 1e-12);
}

TEST_F(BatteryKeeperTest, AnotherBatteryOrADamagedFileIsNotUsedAndSaidSo) {
  keep(2.5, 0.1);
  settings_.battery.capacity_Ah = 5;
  BatteryKeeper other(settings_);
  EXPECT_FALSE(other.load());
  EXPECT_EQ(other.take_notices().size(), 1U);
  settings_.battery.capacity_Ah = 3.7;
  std::ofstream(settings_.log.directory / "battery.state") << "torn";
  BatteryKeeper damaged(settings_);
  EXPECT_FALSE(damaged.load());
  EXPECT_EQ(damaged.take_notices().size(), 1U);
}

TEST_F(BatteryKeeperTest, CommandsAreHeldToTheCapacity) {
  const BatteryKeeper keeper(settings_);
  std::string problem;
  ControlRequest request;
  const auto full = keeper.charge_of(request, problem);
  ASSERT_TRUE(full);
  EXPECT_EQ(full->charge_Ah, 3.7);
  EXPECT_NEAR(full->std_Ah, 0.074, 1e-12);
  for (const double bad : {-0.1, 3.8, std::nan("")}) {
    request.charge_Ah = bad;
    EXPECT_FALSE(keeper.charge_of(request, problem)) << bad;
    EXPECT_EQ(problem, "charge_Ah is 0 to 3.7, the capacity");
  }
  request.charge_Ah = 1;
  request.charge_std_Ah = -1;
  EXPECT_FALSE(keeper.charge_of(request, problem));
}

TEST_F(BatteryKeeperTest, ABatteryThatIsNotCountedTakesNoCommand) {
  settings_.battery.enabled = false;
  std::string problem;
  EXPECT_FALSE(BatteryKeeper(settings_).charge_of({}, problem));
  EXPECT_NE(problem.find("battery.enabled"), std::string::npos);
}

}  // namespace
}  // namespace navcal::daemon
