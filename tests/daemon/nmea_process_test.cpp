// SPDX-License-Identifier: Apache-2.0
// NMEA 0183 on the status socket of a running navcald, as its readers ask for it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "protocols/nmea_attitude.h"
#include "protocols/nmea_position.h"
#include "tests/daemon/daemon_process.h"
#include "tests/daemon/talking_line.h"
#include "tests/support/process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;
namespace nmea = protocols::nmea;

constexpr const char* kOpenCpn = R"(?WATCH={"class":"WATCH", "nmea":true})";
constexpr const char* kSignalK = R"(?WATCH={"class":"WATCH","nmea":true,"json":false})";

std::vector<std::string> no_model(std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--set", "environment.model=false", "--set", "environment.declination_deg=3"});
  return more;
}

/// A line as a sentence; it must be one, with its checksum. Kept, because what is decoded looks into it.
const std::vector<std::uint8_t>& frame_of(const std::string& line) {
  static std::deque<std::vector<std::uint8_t>> kept;
  auto& bytes = kept.emplace_back(line.begin(), line.end());
  bytes.push_back('\n');
  const auto scan = nmea::Scanner::scan(bytes.data(), bytes.data() + bytes.size());
  EXPECT_EQ(scan.length, bytes.size()) << line;
  return bytes;
}

/// Asks as a reader does, and passes over the answers.
std::unique_ptr<Client> reader(const DaemonProcess& daemon, const char* request) {
  auto client = std::make_unique<Client>(daemon.port());
  client->send(request);
  const json watch = json::parse(client->line_with("\"class\":\"WATCH\""));
  EXPECT_EQ(watch["enable"], true);
  EXPECT_EQ(watch["nmea"], true);
  EXPECT_EQ(watch["json"], false);
  return client;
}

TEST(NmeaProcess, PositionAndHeadingsGoToThoseWhoAskAsTheReadersOfNmeaDo) {
  DaemonProcess daemon(no_model({"--set", "status.nmea_heading_std_deg=30"}));
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  for (const char* request : {kOpenCpn, kSignalK}) {
    const auto client = reader(daemon, request);
    const auto next = [&](const std::string& type) {
      for (;;) {
        const std::string line = client->line().value();
        frame_of(line);
        if (line.substr(0, 6) == type) return line;
      }
    };
    const auto rmc = nmea::decode_rmc(nmea::Sentence(frame_of(next("$GPRMC"))));
    EXPECT_NEAR(rmc->place->latitude_deg, 57.71283, 1e-7);
    EXPECT_NEAR(rmc->place->longitude_deg, 12.02259, 1e-7);
    EXPECT_EQ(rmc->date, (protocols::Date{2026, 11, 21}));
    EXPECT_EQ(rmc->time->hour, 12) << "the time that the receiver states";
    EXPECT_EQ(rmc->time->minute, 0);
    EXPECT_EQ(rmc->mode, 'A');
    EXPECT_EQ(rmc->variation_deg->value(), 3);
    int positions = 0;
    while (nmea::decode_gsa(nmea::Sentence(frame_of(next("$GPGSA"))))->fix != protocols::Fix::fix_3d)
      ASSERT_LT(++positions, 50) << "the first may come before the receiver's own GSA";
    const auto gga = nmea::decode_gga(nmea::Sentence(frame_of(next("$GPGGA"))));
    EXPECT_EQ(gga->quality, 1);
    ASSERT_TRUE(gga->altitude_m);
    EXPECT_NEAR(gga->altitude_m->value(), 49.4, 1e-9);
    EXPECT_EQ(nmea::decode_gsv(nmea::Sentence(frame_of(next("$GPGSV"))))->visible, 2);
    const auto hdg = nmea::decode_heading(nmea::Sentence(frame_of(next("$HCHDG"))), nmea::Type::hdg);
    EXPECT_NEAR(hdg->heading_deg->value(), 123.4, 1e-9);
    EXPECT_EQ(hdg->variation_deg->value(), 3);
    const auto hdt = nmea::decode_heading(nmea::Sentence(frame_of(next("$HEHDT"))), nmea::Type::hdt);
    EXPECT_NEAR(hdt->heading_deg->value(), 126.4, 0.5);
    const auto xdr = nmea::decode_xdr(nmea::Sentence(frame_of(next("$IIXDR"))));
    ASSERT_GE(xdr->count, 2U);
    EXPECT_EQ(xdr->transducers[0].name.substr(0, 3), std::string("PIT"));
    EXPECT_NEAR(xdr->transducers[0].value->value(), 1.5, 0.1);
  }
}

TEST(NmeaProcess, AHeadingThatIsNotSureIsNoHdt) {
  DaemonProcess daemon(no_model({"--set", "navigation.heading_error_deg=5"}));
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  const auto client = reader(daemon, kOpenCpn);
  for (int headings = 0, positions = 0; headings < 20 || positions < 5;) {
    const std::string line = client->line().value();
    EXPECT_EQ(line.find("HDT"), std::string::npos) << line;
    headings += line.find("$HCHDG") != std::string::npos ? 1 : 0;
    positions += line.find("RMC") != std::string::npos ? 1 : 0;
  }
}

TEST(NmeaProcess, WithoutFixesTheEstimateIsSentAndSaysSo) {
  DaemonProcess daemon(no_model({"--set", "navigation.interval_s=0.1"}));
  daemon.wait_until_ready();
  auto talking = std::make_unique<TalkingLine>(daemon.line);
  const auto client = reader(daemon, R"(?WATCH={"nmea":true};)");
  client->line_with("$GPRMC");
  talking = std::make_unique<TalkingLine>(daemon.line, TalkingLine::Fixes::none);
  const auto rmc = nmea::decode_rmc(nmea::Sentence(frame_of(client->line_with("$INRMC"))));
  EXPECT_TRUE(rmc->valid);
  EXPECT_EQ(rmc->mode, 'E');
  EXPECT_NEAR(rmc->place->latitude_deg, 57.71283, 1e-3);
  EXPECT_TRUE(rmc->time && rmc->date);
  EXPECT_EQ(nmea::decode_gga(nmea::Sentence(frame_of(client->line_with("$INGGA"))))->quality, 6);
  EXPECT_NE(client->line_with("$INGST"), "");
  for (int i = 0; i < 50; ++i) {
    const std::string line = client->line().value();
    EXPECT_EQ(line.find("$GPRMC"), std::string::npos)
        << "the receiver's silence does not hide the estimate: " << line;
  }
}

TEST(NmeaProcess, ARateAndADeviceCanBeChosen) {
  DaemonProcess daemon(no_model());
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  Client client(daemon.port());
  client.send(R"(?WATCH={"nmea":true,"nmea_rate_Hz":0.01,"device":"compass"})");
  EXPECT_EQ(json::parse(client.line_with("\"class\":\"WATCH\""))["nmea_rate_Hz"], 0.01);
  Client other(daemon.port());
  other.send(kOpenCpn);
  for (int i = 0; i < 5; ++i) other.line_with("$HCHDG");
  client.send("?VERSION;");
  int headings = 0;
  for (std::string line = client.line().value(); line.find("VERSION") == std::string::npos;
       line = client.line().value())
    headings += line.find("$HCHDG") != std::string::npos ? 1 : 0;
  EXPECT_LE(headings, 1);
}

TEST(NmeaProcess, GpspipeShowsTheSentences) {
  DaemonProcess daemon(no_model());
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  if (std::system("command -v gpspipe >/dev/null") != 0) GTEST_SKIP() << "gpspipe is not installed";
  test::Process pipe({"timeout", "60", "gpspipe", "-r", "-n", "60", "127.0.0.1:" + std::to_string(daemon.port())},
                     daemon.folder() / "gpspipe");
  EXPECT_EQ(pipe.wait(std::chrono::seconds(70)), 0);
  for (const char* sentence : {"$GPRMC,1200", "$GPGGA,1200", "$GPGSV,", "$HCHDG,123.40,,,3.0,E"})
    EXPECT_NE(pipe.out().find(sentence), std::string::npos) << sentence << pipe.out();
}

/// gpsd asks a gpsd:// source for JSON and passes it on; the device says where it came from.
TEST(NmeaProcess, AGpsdReadsNavcaldAsASource) {
  if (::access("/usr/sbin/gpsd", X_OK) != 0 || std::system("command -v gpspipe >/dev/null") != 0)
    GTEST_SKIP() << "gpsd is not installed";
  DaemonProcess daemon(no_model());
  daemon.wait_until_ready();
  const TalkingLine talking(daemon.line);
  const std::string port = std::to_string(test::free_port());
  const std::string source = "gpsd://127.0.0.1:" + std::to_string(daemon.port());
  const test::Process gpsd({"/usr/sbin/gpsd", "-N", "-n", "-S", port, source}, daemon.folder() / "gpsd");
  std::string out;
  const bool found = test::eventually(
      [&] {
        test::Process pipe({"timeout", "5", "gpspipe", "-w", "-n", "60", "127.0.0.1:" + port},
                           daemon.folder() / "pipe");
        pipe.wait(std::chrono::seconds(10));
        out = pipe.out();
        return out.find("\"lat\":57.712830000") != std::string::npos &&
               out.find("\"heading\":126.4000") != std::string::npos;
      },
      std::chrono::seconds(90));
  EXPECT_TRUE(found) << out << gpsd.err();
  EXPECT_NE(out.find(source + "#compass"), std::string::npos) << out;
}

}  // namespace
}  // namespace navcal::daemon
