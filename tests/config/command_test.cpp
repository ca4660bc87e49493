// SPDX-License-Identifier: Apache-2.0
// [command]: limits of orders, and settings that contradict each other.
#include <gtest/gtest.h>

#include "config/load.h"
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

Problems command_problems(std::string_view command, const Overrides& overrides = {}) {
  return problems_of(std::string("[command]\n").append(command).append(kGoodPort), overrides);
}

TEST(ConfigCommand, WhatIsGivenIsTakenAndComesBack) {
  const Settings settings =
      parse(std::string("[command]\nmax_rpm = 900\nsafe_rpm = -30\nsafe_fins_deg = [0, 12.5, -12.5]\n")
                .append(kGoodPort),
            "t.toml", {});
  EXPECT_EQ(settings.command.max_rpm, 900);
  EXPECT_EQ(settings.command.safe_rpm, -30);
  EXPECT_EQ(settings.command.safe_fins_deg, (std::array<double, 3>{0, 12.5, -12.5}));
  EXPECT_EQ(settings.command.max_fin_deg, 25);
  EXPECT_EQ(parse(to_toml(settings), "again", {}), settings);
}

TEST(ConfigCommand, ContradictionsNameTheKeyThatWasGiven) {
  EXPECT_EQ(command_problems("max_rpm = 900\nsafe_rpm = -901\n"),
            Problems{"t.toml:3: command.safe_rpm: safe_rpm -901 is beyond max_rpm 900"});
  EXPECT_EQ(command_problems("max_timeout_s = 0.1\n"),
            Problems{"t.toml:2: command.max_timeout_s: min_timeout_s 0.2 is more than max_timeout_s 0.1"});
  EXPECT_EQ(command_problems("safe_fins_deg = [0, 11, 0]\n", {"command.max_fin_deg=10"}),
            Problems{"t.toml:2: command.safe_fins_deg: safe_fins_deg 11 is beyond max_fin_deg 10"});
}

TEST(ConfigCommand, EachValueHasItsRange) {
  EXPECT_EQ(command_problems("max_fin_deg = 26\n"),
            Problems{"t.toml:2: command.max_fin_deg: 26 is out of range: 0 to 25 deg"});
  EXPECT_EQ(command_problems("safe_fins_deg = [0, 0]\n"),
            Problems{"t.toml:2: command.safe_fins_deg: three numbers, each -25 to 25 deg are expected, not an "
                     "array of 2 numbers"});
  EXPECT_EQ(command_problems("max_orders_hz = 5\n"),
            Problems{"t.toml:2: command.max_orders_hz: unknown key; did you mean max_orders_Hz?"});
  EXPECT_EQ(command_problems("max_rpm = nan\n").size(), 1U);
}

}  // namespace
}  // namespace navcal::config
