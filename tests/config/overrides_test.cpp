// SPDX-License-Identifier: Apache-2.0
// --set key=value
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

Settings with(const Overrides& overrides) { return parse(kGoodPort, "t.toml", overrides); }

TEST(ConfigOverrides, EveryKindOfValue) {
  const auto s =
      with({"status.port=29470", "log.enabled=false", "log.sync_interval_s=0.25", "log.directory=/tmp/log",
            "environment.declination_deg=-180", "control.mode=0o600", "port.gps.fix.rollover_pivot=2020-01-01"});
  EXPECT_EQ(s.status.port, 29470);
  EXPECT_FALSE(s.log.enabled);
  EXPECT_EQ(s.log.sync_interval_s, 0.25);
  EXPECT_EQ(s.log.directory, "/tmp/log");
  EXPECT_EQ(s.control.mode, 0600U);
  EXPECT_EQ(s.ports.at(0).gps.rollover_pivot, "2020-01-01");
}

TEST(ConfigOverrides, TextNeedsNoQuotesButMayHaveThem) {
  EXPECT_EQ(with({"log.directory=/a b/c"}).log.directory, "/a b/c");
  EXPECT_EQ(with({"log.directory=\"/a b/c\""}).log.directory, "/a b/c");
  EXPECT_EQ(with({"log.directory=/a=b"}).log.directory, "/a=b");
  EXPECT_EQ(with({"log.directory=/d\u00e9p\u00f4t"}).log.directory, "/d\u00e9p\u00f4t");
}

TEST(ConfigOverrides, ATextThatLooksLikeANumberStaysAsItWasWritten) {
  EXPECT_EQ(with({"port.gps.usb_serial=00123"}).ports.at(0).usb_serial, "00123");
  EXPECT_EQ(with({"port.gps.usb_serial=1e5"}).ports.at(0).usb_serial, "1e5");
  EXPECT_EQ(with({"port.gps.usb_serial=true"}).ports.at(0).usb_serial, "true");
}

TEST(ConfigOverrides, APlaceReplacesWhicheverTheFileHas) {
  const auto s = with({"port.gps.udev_name=/dev/navcal/gps"});
  EXPECT_EQ(s.ports.at(0).path, "");
  EXPECT_EQ(s.ports.at(0).udev_name, "/dev/navcal/gps");
}

TEST(ConfigOverrides, TheLastOneCounts) { EXPECT_EQ(with({"status.port=1", "status.port=2"}).status.port, 2); }

TEST(ConfigOverrides, AProtocolBringsItsDefaults) {
  const auto s = with({"port.gps.protocol=nmea"});
  EXPECT_EQ(s.ports.at(0).protocol, protocols::Protocol::nmea);
  EXPECT_EQ(s.ports.at(0).latency_s, 0);
  EXPECT_EQ(s.ports.at(0).baud, 9600);  // the file says so
}

TEST(ConfigOverrides, Problems) {
  EXPECT_EQ(problems_of(kGoodPort, {"status.prot=1"}),
            Problems{"--set: status.prot: unknown key; did you mean port?"});
  EXPECT_EQ(problems_of(kGoodPort, {"stats.port=1"}),
            Problems{"--set: stats.port: unknown key; did you mean status?"});
  EXPECT_EQ(problems_of(kGoodPort, {"log.enabled=maybe"}),
            Problems{"--set: log.enabled: true or false is expected, not the text \"maybe\""});
  EXPECT_EQ(
      problems_of(kGoodPort, {"log.sync_interval_s=10 ms"}),
      Problems{"--set: log.sync_interval_s: a number in s is expected (0.01 to 60 s), not the text \"10 ms\""});
  EXPECT_EQ(problems_of(kGoodPort, {"port.gsp.baud=9600"}),
            Problems{"--set: port.gsp.baud: the file has no port of this name; did you mean gps?"});
  EXPECT_EQ(problems_of(kGoodPort, {"port.gps.units=1"}), Problems{"--set: port.gps.units: a table is expected"});
  EXPECT_EQ(problems_of(kGoodPort, {"port.gps.fix.a.b=1"}), Problems{"--set: port.gps.fix.a.b: unknown key"});
  EXPECT_EQ(problems_of(kGoodPort, {"log.directory=/a\xff"}),
            Problems{"--set: log.directory: the value is not UTF-8, or too long"});
}

TEST(ConfigOverrides, MisshapenOnes) {
  for (const std::string text : {"", "=", "status.port", "=3"}) {
    EXPECT_EQ(problems_of(kGoodPort, {text}).size(), 1U) << text;
  }
  for (const std::string key : {".", "..", "port", "port.", "port.gps", "port.gps.", "log", "log.",
                                "log.x.y.z.w.v", "log.enabled.x", "a.b.c.d.e.f.g"}) {
    const auto problems = problems_of(kGoodPort, {key + "=3"});
    ASSERT_EQ(problems.size(), 1U) << key;
    EXPECT_TRUE(problems[0].starts_with("--set: ")) << problems[0];
  }
}

TEST(ConfigOverrides, CannotSmuggleInASecondKey) {
  EXPECT_EQ(problems_of(kGoodPort, {"status.port=1\nmax_clients = 2"}).size(), 1U);
}

TEST(ConfigOverrides, ComeAfterTheProblemsOfTheFile) {
  const auto problems = problems_of(std::string(kGoodPort).append("[log]\nenabled=3\n"), {"log.enabled=4"});
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_TRUE(problems[0].starts_with("t.toml:7: "));
  EXPECT_TRUE(problems[1].starts_with("--set: "));
}

}  // namespace
}  // namespace navcal::config
