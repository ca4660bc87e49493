// SPDX-License-Identifier: Apache-2.0
// An autopilot played with node-mavlink sends MAVLink by UDP to navcald: each frame is in the log, the times of
// validity are those of its clock, and it is asked for what is needed.
#include "protocols/mavlink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "record/log/checksum.h"
#include "record/log/log_reader.h"
#include "record/recording.h"
#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using nlohmann::json;
using test::eventually;
using test::Process;

constexpr std::chrono::seconds kPatience{120};

struct MavlinkVehicle : ::testing::Test {
  test::TemporaryFolder folder;
  [[nodiscard]] std::string at(const std::string& name) const { return (folder / name).string(); }

  /// Live samples in the log; the frames that came are counted in `counts`.
  std::vector<json> read_log() {
    std::vector<json> samples;
    protocols::mavlink::Parser parser;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "logs")) {
      if (entry.path().extension() != ".mcap") continue;
      record::LogReader reader(record::open_file(entry.path()), entry.path().string());
      while (const auto message = reader.next()) {
        if (!reader.channels().at(message->channel).raw) {
          samples.push_back(json::parse(message->data));
          continue;
        }

        if (message->data.front() != 0) continue;  // sent by navcald
        const auto bytes =
            message->data.substr(record::kRawHead, message->data.size() - record::kRawHead - record::kRawTail);
        parser.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                    [&](const protocols::Frame& frame) {
                      ++counts[std::string(frame.id.view())];
                      if (protocols::mavlink::find_message(frame.bytes).message.is_untrimmed) ++untrimmed;
                    });
      }
    }
    return samples;
  }
  std::map<std::string, int> counts;
  int untrimmed = 0;
};

TEST_F(MavlinkVehicle, IsReadAskedAndStampedByItsOwnClock) {
  const char* longer = std::getenv("NAVCAL_MAVLINK_SECONDS");
  const std::string seconds = longer != nullptr ? longer : "16", port = std::to_string(test::free_port());
  std::ofstream(folder / "navcald.toml")
      << "[log]\ndirectory = \"" << at("logs")
      << "\"\nfree_floor_MB = 0\n[status]\nport = 0\n[control]\nsocket = \"" << at("control")
      << "\"\n[port.rov]\nprotocol = \"mavlink\"\naddress = \"udp:127.0.0.1:" << port << "\"\n";
  Process daemon({NAVCALD, "--config", at("navcald.toml")}, folder / "navcald");
  ASSERT_TRUE(eventually([&] { return daemon.err().find("opened") != std::string::npos; }, kPatience))
      << daemon.err();
  Process autopilot(
      {"node", NAVCAL_SOURCE_DIR "/tests/end_to_end/mavlink/autopilot.mjs", port, seconds, at("truth.json")},
      folder / "autopilot");
  ASSERT_EQ(autopilot.wait(kPatience + kPatience), 0) << autopilot.err();
  daemon.signal(SIGTERM);
  ASSERT_EQ(daemon.wait(kPatience), 0) << daemon.err();
  const json truth = json::parse(test::read_file(folder / "truth.json"));

  // Every frame is in the log, with those whose sum was taken before the zeros were cut.
  const auto samples = read_log();
  EXPECT_EQ(counts["RAW_IMU"], truth["sent"]["27"]);
  EXPECT_EQ(counts["ATTITUDE"], truth["sent"]["30"]);
  EXPECT_EQ(counts["SERVO_OUTPUT_RAW"], truth["sent"]["36"]);
  EXPECT_EQ(counts["DISTANCE_SENSOR"], truth["sent"]["132"]);
  EXPECT_EQ(counts["HEARTBEAT"], truth["sent"]["0"]);
  EXPECT_GT(untrimmed, 0);

  // Requests to it, in good frames of a component of the vehicle, and those after its restart.
  EXPECT_EQ(truth["bad"], 0);
  std::map<double, int> asked, asked_again;
  int heartbeats = 0, parameters = 0;
  for (const json& came : truth["came"]) {
    EXPECT_EQ(came["system"], 1);
    EXPECT_EQ(came["component"], 197);
    if (came["id"] == 0) ++heartbeats;
    if (came["id"] == 20) ++parameters;
    if (came["id"] != 76) continue;
    ++(came["again"] ? asked_again : asked)[came["message"]];
    if (came["message"] == 27) {
      EXPECT_EQ(came["interval_us"], 20'000);
    }
  }
  EXPECT_GT(heartbeats, 3);
  EXPECT_GE(parameters, 2 * 14) << "of the compass's calibration, and after the restart again";
  for (const double message : {105, 27, 36, 30, 137, 147, 24}) {
    EXPECT_GT(asked[message], 0) << message;
    EXPECT_GT(asked_again[message], 0) << message;
  }

  // Samples: the reading of tick i has the rate of i mrad/s.
  double stamp_s = 0, stamp_s2 = 0, arrival_s = 0, arrival_s2 = 0;
  int readings = 0, within = 0, headings = 0, calibrated = 0, estimates = 0;
  std::map<std::string, std::size_t> kinds;
  const std::size_t ticks = truth["times"].size();
  for (const json& sample : samples) {
    if (sample.value("class", "") == "NAV" && !sample["heading_rad"].is_null()) {
      ++estimates;
      EXPECT_GE(sample["heading_std_rad"], 0.17) << "no less than the autopilot's heading states";
    }
    if (sample.value("device", "") != "rov") continue;
    ++kinds[sample["class"]];
    if (sample.contains("field_body_uT") && !sample["field_body_uT"].is_null()) {
      EXPECT_GE(sample["field_body_uT"][0], 24.99) << "the calibration of the autopilot was not undone";
    }
    if (sample["class"] == "COMPASS" && !sample["heading_calibrated_rad"].is_null()) ++calibrated;
    if (sample["class"] == "COMPASS" && !sample["heading_rad"].is_null()) {
      ++headings;
      EXPECT_NEAR(sample["heading_rad"], 1.5, 1e-6);
      EXPECT_EQ(sample["heading_is_true"], true);
      EXPECT_NEAR(sample["heading_std_rad"], 0.1745, 1e-4);
    }
    if (sample["class"] != "IMU") continue;
    const auto tick = static_cast<std::size_t>(std::lround(sample["rate_rad_s"][0].get<double>() * 1e3));
    ASSERT_LT(tick, ticks);
    if (tick < ticks / 4 || tick >= ticks / 2) continue;
    const double late_s = sample["time"].get<double>() - truth["times"][tick].get<double>();
    const double arrived_s = sample["arrival"].get<double>() - truth["times"][tick].get<double>();
    stamp_s += late_s;
    stamp_s2 += late_s * late_s;
    arrival_s += arrived_s;
    arrival_s2 += arrived_s * arrived_s;
    if (std::abs(late_s) < 1.96 * sample["time_std"].get<double>()) ++within;
    ++readings;
  }
  EXPECT_TRUE(std::ranges::any_of(samples, [](const json& sample) {
    return sample.value("message", "").find("times late by at most") != std::string::npos;
  })) << "by TIMESYNC";
  EXPECT_EQ(kinds["IMU"], ticks);
  EXPECT_GE(kinds["COMPASS"], ticks * 65 / 100)
      << "the tilt, and the field when it changes and its calibration is known";
  EXPECT_EQ(calibrated, 0) << "it has not turned";
  EXPECT_EQ(headings, truth["sent"]["30"]) << "so that the autopilot's own heading serves all the time";
  EXPECT_GT(estimates, 10) << "one a second";
  EXPECT_EQ(kinds["DEPTH"], ticks / 5);
  EXPECT_EQ(kinds["ALTIMETER"], ticks / 5);
  ASSERT_GT(readings, 100);
  // The least delay cannot be seen, and is longer where others run too: of what remains the spread is compared.
  const auto spread_ms = [&](double sum_s, double sum_s2) {
    return 1e3 * std::sqrt(std::max(0.0, sum_s2 / readings - std::pow(sum_s / readings, 2)));
  };
  std::printf(
      "errors of stamps: rms %.2f ms, spread %.2f ms, %.1f %% within 1.96 of their stated error; "
      "of arrivals: rms %.2f ms, spread %.2f ms\n",
      1e3 * std::sqrt(stamp_s2 / readings), spread_ms(stamp_s, stamp_s2), 100.0 * within / readings,
      1e3 * std::sqrt(arrival_s2 / readings), spread_ms(arrival_s, arrival_s2));
  EXPECT_LT(spread_ms(stamp_s, stamp_s2), spread_ms(arrival_s, arrival_s2) / 2);
  EXPECT_LT(stamp_s, arrival_s);
}

}  // namespace
}  // namespace navcal
