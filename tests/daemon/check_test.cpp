// SPDX-License-Identifier: Apache-2.0
#include "daemon/check.h"

#include <gtest/gtest.h>

#include "config/load.h"

namespace navcal::daemon {
namespace {

std::string port(const std::string& name, const std::string& protocol) {
  return "[port." + name + "]\nprotocol = \"" + protocol + "\"\npath = \"/dev/" + name + "\"\n";
}

bool says(const std::string& toml, std::string_view line) {
  const std::string words = describe(config::parse(toml, "t.toml", {}));
  const bool found = words.find(line) != std::string::npos;
  if (!found) ADD_FAILURE() << words;
  return found;
}

TEST(Check, SaysWhichPortMayServeWhat) {
  EXPECT_TRUE(
      says(port("tcm", "tcm2") + port("imu", "imu-card") + port("gps", "oncore") + port("motor", "motor-card"),
           "sources: heading and field by tcm, rates and acceleration and depth by imu, position and velocity "
           "by gps, shaft by motor\n"));
  EXPECT_TRUE(says(
      port("all", "nmea"),
      "sources: heading and position and velocity and altitude by all; nothing gives field, rates, acceleration, "
      "depth, shaft\n"));
  EXPECT_TRUE(says(port("a", "nmea") + port("b", "nmea"),
                   "sources: heading and position and velocity and altitude by a or b;"));
  EXPECT_TRUE(says("[roles]\nheading = \"b\"\n" + port("a", "tcm2") + port("b", "nmea"),
                   "sources: heading by b or a, field by a,"));
}

TEST(Check, SaysWhatTheCalibratorsLearnFrom) {
  EXPECT_TRUE(says(port("all", "nmea"), "calibration: of all;"));
  EXPECT_TRUE(says("[roles]\nheading = \"b\"\n" + port("a", "tcm2") + port("b", "nmea"), "calibration: of a, b;"));
}

TEST(Check, SaysWhatOrdersMayAskForAndWhatFollows) {
  const std::string motor = port("motor", "motor-card");
  EXPECT_TRUE(
      says(motor,
           "orders: to motor up to 1200 rpm (2000 rpm/s) and 25 deg (200 deg/s), at most 40 a second; a lease "
           "of 0.2 to 5 s; then 0 rpm, fins 0 0 0 deg\n"));
  EXPECT_TRUE(says("[command]\nslew_rpm_s = 0\nsafe_fins_deg = [1, -2, 0.5]\n" + motor, "1200 rpm (at once)"));
  EXPECT_TRUE(says("[command]\nenabled = false\n" + motor, "orders: off\n"));
  EXPECT_TRUE(says(motor, "battery: not counted\n"));
  EXPECT_TRUE(says("[battery]\nenabled = true\n" + motor, "battery: 3.7 Ah, 21.6 V, low below 20 %\n"));
  EXPECT_TRUE(says(port("gps", "oncore"), "orders: no motor card to give them to\n"));
}

TEST(Check, SaysWhatIsSwitchedAndWhatTheLogLacks) {
  const std::string gps = port("gps", "oncore");
  EXPECT_TRUE(
      says(gps + "[power.mast]\ngpio_chip = \"gpiochip0\"\nline = 17\ndevices = [\"gps\"]\nat_start = \"leave\"\n",
           "power mast: of gps by line 17 of gpiochip0, left as it is at the start\n"));
  EXPECT_TRUE(says("[log]\nleave_out = [\"raw.gps\", \"health\"]\n" + gps, "log: without raw.gps, health\n"));
}

TEST(Check, SaysWhenceTheEarthsFieldIs) {
  const std::string gps = port("gps", "oncore");
  EXPECT_TRUE(says(gps, "field of the Earth: by the World Magnetic Model from the first fix on\n"));
  EXPECT_TRUE(says("[environment]\ndeclination_deg = 3\n" + gps,
                   "field of the Earth: declination 3.00 deg east as configured; size and dip by the model\n"));
  EXPECT_TRUE(says("[environment]\nmodel = false\n" + gps, "field of the Earth: the declination is not known\n"));
}

}  // namespace
}  // namespace navcal::daemon
