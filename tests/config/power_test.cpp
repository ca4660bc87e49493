// SPDX-License-Identifier: Apache-2.0
// [power.NAME], and what [log] leaves out.
#include <gtest/gtest.h>

#include "config/load.h"
#include "config/log_choice.h"
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

Problems power_problems(std::string_view keys) {
  return problems_beside_a_port(std::string("[power.mast]\n").append(keys));
}

TEST(ConfigPower, WhatIsGivenIsTakenAndComesBack) {
  const Settings settings = parse(std::string(kGoodPort) +
                                      "[power.mast]\ngpio_chip = \"gpiochip0\"\nline = 17\ndevices = [\"gps\"]\n"
                                      "active_low = true\nat_start = \"leave\"\nsettle_s = 2.5\n",
                                  "t.toml", {"power.mast.line=18"});
  ASSERT_EQ(settings.power.size(), 1U);
  PowerSettings expected;
  expected.name = "mast";
  expected.gpio_chip = "gpiochip0";
  expected.line = 18;
  expected.devices = {"gps"};
  expected.active_low = true;
  expected.at_start = PowerAtStart::leave;
  expected.settle_s = 2.5;
  EXPECT_EQ(settings.power.front(), expected);
  EXPECT_EQ(parse(to_toml(settings), "again", {}), settings);
}

TEST(ConfigPower, WhatIsMissingWrongOrSharedIsNamed) {
  EXPECT_EQ(power_problems(""),
            (Problems{"t.toml:6: power.mast.gpio_chip: missing: the controller of the line",
                      "t.toml:6: power.mast.line: missing: the number of the line",
                      "t.toml:6: power.mast.devices: missing: the ports whose devices it feeds"}));
  EXPECT_EQ(power_problems("gpio_chip = \"gpiochip0\"\nline = 1\ndevices = [\"gpz\"]\n"),
            Problems{"t.toml:6: power.mast.devices: there is no port gpz"});
  EXPECT_EQ(power_problems("gpio_chip = \"../mem\"\nline = 1\ndevices = [\"gps\"]\n").size(), 2U);
  EXPECT_EQ(power_problems("gpio_chip = \"gpiochip0\"\nline = 1\ndevices = \"gps\"\n").size(), 2U);
  EXPECT_EQ(power_problems("gpio_chip = \"gpiochip0\"\nlime = 1\nline = 1\ndevices = [\"gps\"]\n"),
            Problems{"t.toml:8: power.mast.lime: unknown key; did you mean line?"});
  EXPECT_EQ(power_problems("gpio_chip = \"gpiochip0\"\nline = 1\ndevices = [\"gps\"]\n"
                           "[power.two]\ngpio_chip = \"gpiochip0\"\nline = 1\ndevices = [\"gps\"]\n"),
            (Problems{"t.toml:10: power.two.line: 1 is already power.mast's",
                      "t.toml:10: power.two.devices: power.mast feeds gps already"}));
  EXPECT_EQ(problems_beside_a_port("power = 3\n").size(), 0U + 1);
}

TEST(ConfigLogChoice, GroupsAndThePortsThatExistCanBeLeftOut) {
  const Settings settings =
      parse("[log]\nleave_out = [\"navigation\", \"raw.gps\"]\n" + std::string(kGoodPort), "t.toml", {});
  EXPECT_EQ(settings.log.leave_out, (std::vector<std::string>{"navigation", "raw.gps"}));
  EXPECT_EQ(problems_of("[log]\nleave_out = [\"raw.imu\"]\n" + std::string(kGoodPort)),
            Problems{"t.toml:2: log.leave_out: there is no port imu"});
  for (const char* bad : {"[\"events\"]", "[\"raw.\"]", "[\"raw.../x\"]", "[1]", "\"raw\"", "[\"raw\", 1]"})
    EXPECT_EQ(problems_of(std::string("[log]\nleave_out = ") + bad + "\n" + std::string(kGoodPort)).size(), 1U)
        << bad;
  EXPECT_TRUE(problems_of("[log]\nleave_out = []\n" + std::string(kGoodPort)).empty());
}

}  // namespace
}  // namespace navcal::config
