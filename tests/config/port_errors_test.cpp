// SPDX-License-Identifier: Apache-2.0
// Every kind of mistake in a port's table.
#include <fmt/format.h>

#include "protocols/device_types.h"
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

std::string compass(std::string_view more) {
  return "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/ttyS1\"\n" + std::string(more);
}

TEST(ConfigPortErrors, NoPorts) {
  const Problems none{
      "t.toml:1: port: no port is configured; a port is a table [port.NAME] with a protocol and a path"};
  EXPECT_EQ(problems_of(""), none);
  EXPECT_EQ(problems_of("[port]\n"), none);
}

/// "tcm2, imu-card, ... or samples".
std::string known_protocols() {
  std::string names;
  for (const auto& device : protocols::kDeviceTypes) {
    const bool is_last = device.protocol == protocols::kDeviceTypes.back().protocol;
    if (!names.empty()) names += is_last ? " or " : ", ";
    names += device.name;
  }
  return names;
}

TEST(ConfigPortErrors, UnknownProtocolListsTheKnown) {
  EXPECT_EQ(problems_of("[port.compass]\nprotocol = \"tcm\"\npath = \"/dev/ttyS1\"\n"),
            Problems{"t.toml:2: port.compass.protocol: unknown protocol \"tcm\"; known: " + known_protocols()});
}

TEST(ConfigPortErrors, MissingProtocol) {
  EXPECT_EQ(problems_of("[port.compass]\npath = \"/dev/ttyS1\"\n"),
            Problems{"t.toml:1: port.compass.protocol: missing; known: " + known_protocols()});
}

TEST(ConfigPortErrors, NoPlace) {
  EXPECT_EQ(problems_of("[port.compass]\nprotocol = \"tcm2\"\n"),
            Problems{"t.toml:1: port.compass: the place is missing: path, udev_name, usb_serial or address"});
}

TEST(ConfigPortErrors, AnEmptyPlaceIsNone) {
  EXPECT_EQ(
      problems_of("[port.compass]\nprotocol = \"tcm2\"\nusb_serial = \"\"\n"),
      (Problems{"t.toml:1: port.compass: the place is missing: path, udev_name, usb_serial or address",
                "t.toml:3: port.compass.usb_serial: \"\" is not a serial number without control characters"}));
}

TEST(ConfigPortErrors, AnAddressIsNoPath) {
  EXPECT_EQ(problems_of("[port.compass]\nprotocol = \"tcm2\"\npath = \"tcp://vehicle:4001\"\n"),
            (Problems{"t.toml:1: port.compass: the place is missing: path, udev_name, usb_serial or address",
                      "t.toml:3: port.compass.path: \"tcp://vehicle:4001\" is not a path on this machine without "
                      "control characters"}));
}

TEST(ConfigPortErrors, SeveralPlaces) {
  const Problems several{
      "t.toml:1: port.compass: only one of path, udev_name, usb_serial and address may be given"};
  EXPECT_EQ(problems_of(compass("udev_name = \"x\"\n")), several);
  EXPECT_EQ(problems_of(compass("usb_serial = \"x\"\n")), several);
  EXPECT_EQ(problems_of(compass("usb_serial = \"x\"\nudev_name = \"y\"\n")), several);
}

TEST(ConfigPortErrors, TwoPortsInOnePlace) {
  for (const std::string place : {"path", "udev_name", "usb_serial"}) {
    const auto toml = fmt::format(
        "[port.b]\nprotocol = \"nmea\"\n{0} = \"X\"\n[port.a]\nprotocol = \"tcm2\"\n{0} = \"X\"\n", place);
    EXPECT_EQ(problems_of(toml),
              Problems{fmt::format("t.toml:4: port.a.{}: X is already port.b's (line 1)", place)});
  }
}

TEST(ConfigPortErrors, TwoPortsOfOneName) {
  const auto problems = problems_of(compass("") + compass(""));
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_TRUE(problems[0].starts_with("t.toml:4: ")) << problems[0];
  EXPECT_NE(problems[0].find("port.compass"), std::string::npos) << problems[0];
}

TEST(ConfigPortErrors, Names) {
  const auto named = [](const std::string& name) {
    return problems_of(fmt::format("[port.{}]\nprotocol = \"tcm2\"\npath = \"/dev/x\"\n", name));
  };
  EXPECT_EQ(named("a"), Problems{});
  EXPECT_EQ(named("front_compass-2"), Problems{});
  EXPECT_EQ(named(std::string(31, 'a')), Problems{});
  for (const std::string& bad : {std::string(32, 'a'), std::string("Compass"), std::string("\"\""),
                                 std::string("\"a/b\""), std::string("\"a.b\""), std::string("\"a b\"")}) {
    const auto problems = named(bad);
    ASSERT_EQ(problems.size(), 1U) << bad;
    EXPECT_TRUE(problems[0].ends_with(": a port's name is 1 to 31 of a-z, 0-9, _ and -")) << problems[0];
  }
}

TEST(ConfigPortErrors, UnknownKeys) {
  EXPECT_EQ(problems_of(compass("bauds = 9600\n")),
            Problems{"t.toml:4: port.compass.bauds: unknown key; did you mean baud?"});
  EXPECT_EQ(problems_of(compass("[port.compass.unit]\nheading = \"deg\"\n")),
            Problems{"t.toml:4: port.compass.unit: unknown key; did you mean units?"});
  EXPECT_EQ(problems_of(compass("[port.compass.units]\nhead = \"deg\"\n")),
            Problems{"t.toml:5: port.compass.units.head: unknown key"});
  EXPECT_EQ(
      problems_of(compass("[port.compass.units]\nheading.x.y.z = 1\n")),
      Problems{"t.toml:5: port.compass.units.heading: a text is expected (deg, mils or counts16), not a table"});
}

TEST(ConfigPortErrors, TablesAndValuesInEachOthersPlace) {
  EXPECT_EQ(problems_of(compass("units = \"deg\"\n")),
            Problems{"t.toml:4: port.compass.units: a table is expected"});
  EXPECT_EQ(
      problems_of(compass("baud.x = 9600\n")),
      Problems{"t.toml:4: port.compass.baud: a whole number is expected (50 to 4000000 bit/s), not a table"});
  EXPECT_EQ(problems_of("port = 3\n").at(0), "t.toml:1: port: tables [port.NAME] are expected");
  EXPECT_EQ(problems_of("[port]\ncompass = \"/dev/ttyS0\"\n").at(1),
            "t.toml:2: port.compass: a table is expected");
}

TEST(ConfigPortErrors, SettingsOfAnotherProtocol) {
  EXPECT_EQ(problems_of(compass("[port.compass.channels]\nzero_mV = [1, 2, 3, 4, 5, 6, 7, 8]\n")),
            Problems{"t.toml:5: port.compass.channels.zero_mV: a port of protocol tcm2 has no such setting"});
}

TEST(ConfigPortErrors, Channels) {
  const auto imu = [](std::string_view more) {
    return problems_of("[port.imu]\nprotocol = \"imu-card\"\npath = \"/dev/x\"\n[port.imu.channels]\n" +
                       std::string(more));
  };
  EXPECT_EQ(imu("zero_mV = [1, 2, 3, 4, 5, 6, 7, 8.5]\n"), Problems{});
  EXPECT_EQ(imu("zero_mV = [1, 2, 3]\n"), Problems{"t.toml:5: port.imu.channels.zero_mV: eight numbers, each "
                                                   "-10000 to 10000 mV are expected, not an array of "
                                                   "3 numbers"});
  EXPECT_EQ(imu("zero_mV = [1, 2, 3, 4, 5, 6, 7, \"8\"]\n"),
            Problems{"t.toml:5: port.imu.channels.zero_mV: eight numbers, each -10000 to 10000 mV are expected, "
                     "not an array"});
  EXPECT_EQ(imu("scale = [1, 1, 1, 1, 1, 1, 1, 0]\n"),
            Problems{"t.toml:5: port.imu.channels.scale: 0 is out of range: eight numbers, each -100000 to 100000 "
                     "mV per deg/s, "
                     "per g, per m and not 0"});
}

TEST(ConfigPortErrors, Mounting) {
  const auto port = [](std::string_view protocol, std::string_view more) {
    return problems_of(
        fmt::format("[port.a]\nprotocol = \"{}\"\npath = \"/dev/x\"\n[port.a.mounting]\n{}\n", protocol, more));
  };
  EXPECT_EQ(port("imu-card", "rotation_deg = [180, 0, -90.5]\nposition_m = [0.1, 0, 0.2]"), Problems{});
  EXPECT_EQ(port("tcm2", "rotation_deg = [0, 0, 90]"), Problems{});
  EXPECT_EQ(port("oncore", "position_m = [0, 0, -0.3]"), Problems{});
  EXPECT_EQ(port("nmea", "rotation_deg = [0, 0, 90]\nposition_m = [0, 0, -0.3]"), Problems{});
  for (const char* doppler_log : {"waterlinked", "pd0", "pd6"})
    EXPECT_EQ(port(doppler_log, "rotation_deg = [0, 0, 45]\nposition_m = [0.5, 0, 0.1]"), Problems{});
  EXPECT_EQ(port("keller", "position_m = [0.5, 0, 0.1]"), Problems{});
  EXPECT_EQ(
      port("imu-card", "rotation_deg = [1, 2]"),
      Problems{"t.toml:5: port.a.mounting.rotation_deg: three numbers, each -360 to 360 deg are expected, not an "
               "array of 2 numbers"});
  EXPECT_EQ(
      port("imu-card", "position_m = [0, 0, 101]"),
      Problems{"t.toml:5: port.a.mounting.position_m: 101 is out of range: three numbers, each -100 to 100 m"});
  EXPECT_EQ(port("tcm2", "position_m = [0, 0, 0]"),
            Problems{"t.toml:5: port.a.mounting.position_m: a port of protocol tcm2 has no such setting"});
  EXPECT_EQ(port("oncore", "rotation_deg = [0, 0, 0]"),
            Problems{"t.toml:5: port.a.mounting.rotation_deg: a port of protocol oncore has no such setting"});
  EXPECT_EQ(port("keller", "rotation_deg = [0, 0, 0]"),
            Problems{"t.toml:5: port.a.mounting.rotation_deg: a port of protocol keller has no such setting"});
  EXPECT_EQ(port("motor-card", "position_m = [0, 0, 0]"),
            Problems{"t.toml:5: port.a.mounting.position_m: a port of protocol motor-card has no such setting"});
}

TEST(ConfigPortErrors, RolloverPivotIsADayOfTheCalendar) {
  const auto pivot = [](std::string_view value) {
    return problems_beside_a_port(fmt::format("[port.gps.fix]\nrollover_pivot = {}\n", value));
  };
  EXPECT_EQ(pivot("\"2019-04-07\""), Problems{});
  EXPECT_EQ(pivot("2019-04-07"), Problems{});  // TOML has dates
  EXPECT_EQ(pivot("\"2020-02-29\""), Problems{});
  EXPECT_EQ(pivot("\"1980-01-06\""), Problems{});
  for (const std::string bad :
       {"\"2019-02-29\"", "\"2019-13-01\"", "\"2019-00-10\"", "\"1980-01-05\"", "\"7 April 2019\"", "\"2019-4-7\"",
        "\"2019-04-07 \"", "\"-019-04-07\"", "\"\"", "20190407"}) {
    const auto problems = pivot(bad);
    ASSERT_EQ(problems.size(), 1U) << bad;
    EXPECT_TRUE(problems[0].starts_with("t.toml:7: port.gps.fix.rollover_pivot: ")) << problems[0];
    EXPECT_NE(problems[0].find("a date, YYYY-MM-DD, from 1980-01-06 on"), std::string::npos) << problems[0];
  }
}

TEST(ConfigPortErrors, MoreThan256Ports) {
  std::string toml;
  for (int i = 0; i < 257; ++i) toml += fmt::format("[port.p{0}]\nprotocol = \"nmea\"\npath = \"/dev/p{0}\"\n", i);
  EXPECT_EQ(problems_of(toml), Problems{"t.toml:1: port: 257 ports are configured; 256 is the most"});
}

}  // namespace
}  // namespace navcal::config
