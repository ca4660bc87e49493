// SPDX-License-Identifier: Apache-2.0
// gpsd's own clients against navcald: what they read is what the instruments said.
#include <gps.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "tests/daemon/daemon_process.h"
#include "tests/daemon/talking_line.h"

namespace navcal::daemon {
namespace {

/// Output of a command.
std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string out;
  std::array<char, 4096> chunk{};
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), pipe.get())) out.append(chunk.data(), n);
  return out;
}

bool installed(const char* program) {
  return std::system(("command -v " + std::string(program) + " >/dev/null").c_str()) == 0;
}

TEST(GpsdClients, LibgpsReadsEveryReport) {
  DaemonProcess daemon({"--set", "environment.model=false"});
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  auto data = std::make_unique<gps_data_t>();
  ASSERT_EQ(gps_open("127.0.0.1", std::to_string(daemon.port()).c_str(), data.get()), 0);
  gps_stream(data.get(), WATCH_ENABLE | WATCH_JSON | WATCH_NMEA, nullptr);
  bool attitude = false, position = false, sky = false;
  for (int i = 0; i < 400 && !(attitude && position && sky); ++i) {
    ASSERT_TRUE(gps_waiting(data.get(), 20'000'000));
    data->set = 0;
    ASSERT_GE(gps_read(data.get(), nullptr, 0), 0) << "libgps refuses a line";
    if ((data->set & ATTITUDE_SET) != 0) {
      attitude = true;
      EXPECT_NEAR(data->attitude.heading, 123.4, 1e-4);
      EXPECT_NEAR(data->attitude.pitch, 1.5, 1e-4);
      EXPECT_NEAR(data->attitude.roll, -2.5, 1e-4);
    }
    if ((data->set & LATLON_SET) != 0) {
      position = true;
      EXPECT_NEAR(data->fix.latitude, 57.71283, 1e-8);
      EXPECT_NEAR(data->fix.longitude, 12.02259, 1e-8);
    }
    if ((data->set & SATELLITE_SET) != 0) {
      sky = true;
      EXPECT_EQ(data->satellites_visible, 2);
    }
  }
  EXPECT_TRUE(attitude && position && sky);
  gps_close(data.get());
}

/// Lines with every key and class that navcald has and gpsd has not.
TEST(GpsdClients, LibgpsPassesOverWhatItDoesNotKnow) {
  for (
      const char* line :
      {R"({"class":"ATT","device":"imu","gyro_x":1.5,"gyro_z":3.25,"gyro_b_z":3.0,"acc_z":-9.8,"depth":4.5})",
       R"({"class":"ATT","device":"compass","time_std":0.002,"heading":1.0,"heading_std":0.5,"pitch_std":0.2,"roll_std":0.2,"error":"001","depth":4.5})",
       R"({"class":"HEALTH","alarms":[{"alarm":"leak_aft","device":"imu"}],"ports":[{"device":"imu"}]})",
       R"({"class":"TIME","source":"gps","bound":null})", R"({"class":"LOG","state":"writing"})",
       R"({"class":"CALIB","calibrators":[]})",
       R"({"class":"RECORD","topic":"/imu","device":"imu","time":1.5,"message":{"class":"IMU","rate_rad_s":[0,null,1]}})",
       R"({"class":"MOTOR","device":"motor","rpm":100,"fins_rad":[0,null,1]})",
       R"({"class":"TPV","device":"gps","mode":3,"lat":1.0,"lon":2.0,"time_corrected":true,"leap_known":false})"}) {
    auto data = std::make_unique<gps_data_t>();
    std::string buffer = line;
    EXPECT_EQ(gps_unpack(buffer.data(), data.get()), 0) << line;
    if (std::strstr(line, "\"depth\"") != nullptr) {
      EXPECT_EQ(data->attitude.depth, 4.5) << line;
    }
  }
}

TEST(GpsdClients, GpspipeShowsPositionAndAttitude) {
  if (!installed("gpspipe")) GTEST_SKIP() << "gpspipe is not installed";
  DaemonProcess daemon({"--set", "environment.model=false"});
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  const std::string out = output_of("timeout 60 gpspipe -w -n 60 127.0.0.1:" + std::to_string(daemon.port()));
  EXPECT_NE(out.find("\"class\":\"TPV\""), std::string::npos) << out;
  EXPECT_NE(out.find("\"class\":\"SKY\""), std::string::npos);
  EXPECT_NE(out.find("\"heading\":123.4000"), std::string::npos);
}

/// gpsd's library for Python hands on only lines that end with CR LF.
TEST(GpsdClients, ProgramsInPythonReadThePosition) {
  if (!installed("gpscsv") || !installed("gpsprof")) GTEST_SKIP() << "gpscsv or gpsprof is not installed";
  DaemonProcess daemon({"--set", "environment.model=false"});
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  const std::string place = " 127.0.0.1:" + std::to_string(daemon.port()) + " 2>&1";
  const std::string csv = output_of("timeout 60 gpscsv -n 3" + place);
  EXPECT_NE(csv.find("57.71283"), std::string::npos) << csv;
  const std::string profile = output_of("timeout 60 gpsprof -n 5" + place);
  EXPECT_NE(profile.find("57.71283"), std::string::npos) << profile;
  EXPECT_NE(profile.find("cycle 0"), std::string::npos) << profile;
}

TEST(GpsdClients, CgpsShowsTheFix) {
  if (!installed("cgps") || !installed("script")) GTEST_SKIP() << "cgps or script is not installed";
  DaemonProcess daemon({"--set", "environment.model=false"});
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  const std::string screen =
      output_of("TERM=xterm timeout 5 script -qc 'stty rows 40 cols 100; cgps -s 127.0.0.1:" +
                std::to_string(daemon.port()) + "' /dev/null </dev/null");
  // It rewrites only what changes on its screen, and releases differ in their columns, so words are looked for.
  for (const char* part : {"57.71283000 N", "12.02259000 E", "49.400", "43.0", "174.0", "44.0  Y"}) {
    EXPECT_NE(screen.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace navcal::daemon
