// SPDX-License-Identifier: Apache-2.0
// Configurations that navcal start writes, and its words on what arrives.
#include "cli/live/start_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/failure.h"
#include "config/load.h"

namespace navcal::cli {
namespace {

StartRequest request_of(const std::string& kind) {
  StartRequest request;
  request.kind = kind;
  request.output = "/somewhere/a \"b\"/navcald.toml";
  return request;
}

config::Settings settings_of(const StartRequest& request) {
  const StartPlan plan = start_plan(request);
  config::Settings settings = config::parse(plan.toml, "plan");
  EXPECT_EQ(settings.ports.size(), 1U);
  EXPECT_EQ(settings.ports.front().name, plan.port);
  return settings;
}

TEST(StartPlan, ABlueRov2IsReadAsItsPageSays) {
  const auto settings = settings_of(request_of("bluerov2"));
  EXPECT_EQ(settings.ports[0].address, "udp:0.0.0.0:14551");
  EXPECT_EQ(settings.ports[0].pressure_sensor, 2);
  EXPECT_EQ(settings.log.directory, "/somewhere/a \"b\"/log");
  EXPECT_EQ(settings.control.socket, "/somewhere/a \"b\"/control");
  EXPECT_EQ(settings.status.port, 2947);

  StartRequest serial = request_of("bluerov2");
  serial.device = "/dev/ttyACM0";
  EXPECT_EQ(settings_of(serial).ports[0].baud, 115200);
  EXPECT_EQ(settings_of(serial).ports[0].rate_Hz, 0);
  serial.baud = 57600;
  EXPECT_EQ(settings_of(serial).ports[0].rate_Hz, 20);
}

TEST(StartPlan, OtherKinds) {
  StartRequest gpsd = request_of("gpsd"), nmea = request_of("nmea"), ros2 = request_of("ros2");
  gpsd.device = nmea.device = "/dev/ttyUSB0";
  EXPECT_EQ(settings_of(gpsd).ports[0].baud, 9600);
  EXPECT_EQ(settings_of(nmea).ports[0].baud, 4800);
  EXPECT_EQ(settings_of(ros2).ports[0].address, "unix-listen:/somewhere/a \"b\"/samples");
  nmea.device.clear();
  nmea.address = "tcp:192.168.2.20:4001";
  EXPECT_EQ(settings_of(nmea).ports[0].address, nmea.address);
}

TEST(StartPlan, TheServiceKeepsItsOwnFolders) {
  StartRequest request = request_of("ros2");
  request.output = "/etc/navcal/navcald.toml";
  const StartPlan plan = start_plan(request);
  EXPECT_TRUE(plan.is_service);
  EXPECT_EQ(plan.samples, "/run/navcal/samples");
  const auto settings = settings_of(request);
  EXPECT_EQ(settings.log, config::LogSettings{});
  EXPECT_EQ(settings.control, config::ControlSettings{});
}

TEST(StartPlan, OptionsOfAnotherKindAreRefused) {
  StartRequest ros2 = request_of("ros2"), both = request_of("nmea"), gpsd = request_of("gpsd");
  ros2.device = both.device = "/dev/ttyUSB0";
  both.address = gpsd.address = "udp:0.0.0.0:10110";
  StartRequest topics = request_of("nmea");
  topics.topics = {"imu=/imu/data"};
  for (const StartRequest& wrong : {ros2, both, gpsd, topics}) {
    try {
      (void)start_plan(wrong);
      ADD_FAILURE() << wrong.kind;
    } catch (const base::Failure& failure) {
      EXPECT_EQ(failure.status(), base::Exit::usage);
    }
  }
}

TEST(Arrivals, AHeadingThatTheAutopilotEstimatesIsCalledSo) {
  Arrivals arrivals("rov");
  arrivals.take(R"({"class":"HEALTH","sources":{"heading":"rov","rates":"rov"},)"
                R"("heading_source":"autopilot","ports":[{"device":"rov","state":"running"}]})");
  EXPECT_NE(arrivals.came().find("serves heading (the autopilot's own until a calibration is in force), rates\n"),
            std::string::npos)
      << arrivals.came();
}

TEST(Arrivals, RatesStampsAndWhatIsMissing) {
  Arrivals arrivals("rov");
  const std::vector<ExpectedQuantity> expected{{"rates", "Ask."}, {"depth", "Dive."}};
  EXPECT_EQ(arrivals.missing(expected, "Switch it on."), "No measurement arrives. Switch it on.\n");
  EXPECT_EQ(arrivals.came(), "port rov: navcald says nothing of it\n");
  for (int i = 0; i < 20; ++i) {
    for (const char* const device : {"rov", "other"})
      arrivals.take(fmt::format(R"({{"class":"RECORD","topic":"/imu","device":"{}","message":{{"class":"IMU",)"
                                R"("time":{},"time_std":0.002,"arrival":{}}}}})",
                                device, 100 + i, 100.005 + i));
  }
  arrivals.take(R"({"class":"RECORD","topic":"/event","device":"rov","message":{"class":"EVENT"}})");
  arrivals.take("{nothing");
  arrivals.take(
      R"({"class":"HEALTH","sources":{"rates":"rov","heading":"other"},"utc":{"source":"gps","bound_s":0.06},)"
      R"("ports":[{"device":"other","state":"silent"},{"device":"rov","state":"running","start_up":"system 1"}]})");
  EXPECT_EQ(arrivals.came(),
            "port rov: running; system 1\n"
            "  IMU             1.0 a second, times known to 2.0 ms, 5.0 ms old on arrival\n"
            "  serves rates\n"
            "UTC: gps, bound of its error 0.060 s\n");
  EXPECT_EQ(arrivals.missing(expected, "Switch it on."), "No depth arrives. Dive.\n");
  arrivals.take(
      R"({"class":"HEALTH","ports":[{"device":"rov","state":"away","reason":"Address already in use"}]})");
  EXPECT_EQ(arrivals.missing(expected, "Switch it on."),
            "The port is not open: Address already in use. Switch it on.\n");
}

}  // namespace
}  // namespace navcal::cli
