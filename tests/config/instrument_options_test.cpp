// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "config/load.h"
#include "config/options.h"

namespace navcal::config {
namespace {

constexpr const char* kPort = "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/ttyS0\"\n";

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse(kPort + text, "n.toml"));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(InstrumentOptions, AFileOfAnOlderVersionSetsTheSame) {
  const Settings old = parse(std::string(kPort) +
                                 "[calibration]\ngyro_noise_deg_s = 0.4\ntilt_lag_s = 0.1\nposition_noise_m = 3\n"
                                 "velocity_noise_m_s = 0.2\n",
                             "old.toml");
  const Settings now = parse(std::string(kPort) +
                                 "[instruments]\nimu_gyro_noise_deg_s = 0.4\ncompass_tilt_lag_s = 0.1\n"
                                 "gps_position_noise_m = 3\ngps_velocity_noise_m_s = 0.2\n",
                             "now.toml");
  EXPECT_EQ(old, now);
  EXPECT_NE(now.instruments, InstrumentSettings{});
  EXPECT_EQ(to_toml(old).find("\ntilt_lag_s"), std::string::npos) << "it is written under its new name only";
}

TEST(InstrumentOptions, EveryOlderNameLeadsToAnOption) {
  std::size_t moved = 0;
  for (const auto& option : daemon_options()) {
    if (option.moved_to.empty()) continue;
    ++moved;
    bool found = false;
    for (const auto& other : daemon_options()) found = found || other.name() == option.moved_to;
    EXPECT_TRUE(found) << option.name();
  }
  EXPECT_EQ(moved, 4U);
}

TEST(InstrumentOptions, TheSameValueUnderBothNamesIsRefusedWithBothLines) {
  EXPECT_EQ(
      refusal("[calibration]\ntilt_lag_s = 0.1\n[instruments]\ncompass_tilt_lag_s = 0.3\n"),
      "n.toml:5: calibration.tilt_lag_s: this is instruments.compass_tilt_lag_s now, which is stated too (line "
      "7)");
}

TEST(InstrumentOptions, WhatIsOutOfRangeNamesLineKeyAndRange) {
  EXPECT_EQ(refusal("[instruments]\ncompass_field_noise_uT = 0\n"),
            "n.toml:5: instruments.compass_field_noise_uT: 0 is out of range: 0.001 to 20 uT");
  EXPECT_NE(refusal("[instruments]\ncompass_fild_noise_uT = 1\n").find("compass_field_noise_uT"),
            std::string::npos)
      << "a slip of the pen gets a suggestion";
  EXPECT_NE(refusal("[instruments]\nimu_depth_noise_m = 'x'\n"), "");
}

TEST(InstrumentOptions, TheLongestSearchIsNotShorterThanTheShortest) {
  EXPECT_EQ(refusal("[instruments]\ngps_longest_search_s = 1\n"),
            "n.toml:5: instruments.gps_longest_search_s: 1 s is less than the shortest, 2 s");
  EXPECT_EQ(refusal("[instruments]\ngps_least_search_s = 20\n"),
            "n.toml:5: instruments.gps_longest_search_s: 10 s is less than the shortest, 20 s");
  EXPECT_EQ(refusal("[instruments]\ngps_least_search_s = 20\ngps_longest_search_s = 20\n"), "");
}

}  // namespace
}  // namespace navcal::config
