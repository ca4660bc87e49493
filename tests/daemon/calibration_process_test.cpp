// SPDX-License-Identifier: Apache-2.0
// Calibrators of a running navcald: what it reports, what it is told on its control socket, what it keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "protocols/tcm2_word.h"
#include "record/log/log_reader.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

/// A navcald with a TCM2 whose log folder outlives it.
class CalibrationProcess : public testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> settings() const {
    return {"--set", "port.compass.protocol=tcm2",     "--set", "port.compass.start_up=false",
            "--set", "log.directory=" + log_.string(), "--set", "status.health_interval_s=0.1"};
  }
  static json ask(Client& control, const std::string& line) {
    control.send(line + "\n");
    return json::parse(control.line().value());
  }
  [[nodiscard]] std::filesystem::path state() const { return log_ / "calibration.state"; }
  /// Objects on /calib of all logs.
  [[nodiscard]] std::vector<json> calib() const {
    std::vector<json> found;
    for (const auto& entry : std::filesystem::directory_iterator(log_)) {
      if (entry.path().extension() != ".mcap") continue;
      record::LogReader reader(record::open_file(entry.path()), entry.path().string());
      while (const auto message = reader.next()) {
        if (reader.channels().at(message->channel).topic == "/calib") found.push_back(json::parse(message->data));
      }
    }
    return found;
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path log_ = folder_.path() / "log";
};

TEST_F(CalibrationProcess, ReportsItsCalibratorsAndTakesOrders) {
  DaemonProcess daemon(settings());
  daemon.wait_until_ready();
  Client watcher(daemon.port());
  watcher.send("?WATCH={\"enable\":true,\"json\":true};\n");
  const json calib = json::parse(watcher.line_with("\"class\":\"CALIB\""));
  EXPECT_EQ(calib["name"], "none");
  ASSERT_EQ(calib["calibrators"].size(), 1U) << "there is no gyro and no GPS";
  EXPECT_EQ(calib["calibrators"][0]["calibrator"], "magnetometer");
  EXPECT_EQ(calib["calibrators"][0]["verdict"], "refused");
  EXPECT_FALSE(calib["calibrators"][0]["reason"].get<std::string>().empty());
  EXPECT_EQ(calib["rose"].size(), 36U);

  Client control(daemon.folder() / "control");
  EXPECT_EQ(ask(control, R"({"command":"calibration.start","calibrator":"magnetometer"})")["ok"], true);
  const json accept = ask(control, R"({"command":"calibration.accept","calibrator":"magnetometer"})");
  EXPECT_EQ(accept["ok"], false);
  EXPECT_EQ(accept["error"].get<std::string>().rfind("refused: ", 0), 0U) << accept;
  EXPECT_EQ(ask(control, R"({"command":"calibration.rollback","calibrator":"magnetometer"})")["error"],
            "nothing to go back to");
  EXPECT_EQ(ask(control, R"({"command":"calibration.accept","calibrator":"gyro"})")["error"],
            "the configuration has no instruments for it");
  EXPECT_EQ(ask(control, R"({"command":"log.rotate"})")["ok"], true);
  EXPECT_EQ(daemon.stop(SIGTERM), 0);

  EXPECT_TRUE(std::filesystem::exists(state()));
  std::map<std::string, int> causes;
  for (const json& one : this->calib()) ++causes[one["class"] == "CALIBRATION" ? one["cause"] : one["class"]];
  EXPECT_EQ(causes["begin"], 2) << "every file begins with the calibration in force";
  EXPECT_EQ(causes["start"], 1);
  EXPECT_GE(causes["CALIB"], 2);
}

TEST_F(CalibrationProcess, TheOperatorMayForceWhatIsRefused) {
  DaemonProcess daemon(settings());
  daemon.wait_until_ready();
  Client control(daemon.folder() / "control");
  const std::string force = R"({"command":"calibration.accept","calibrator":"magnetometer","force":true})";
  EXPECT_EQ(ask(control, force)["error"].get<std::string>().rfind("there is no estimate yet", 0), 0U);
  // A third of a circle: an estimate, but none that is supported.
  json forced = json::object();
  for (int i = 0; i < 1000 && !forced.value("ok", false); ++i) {
    protocols::tcm2::Word word;
    const double heading_deg = i % 120, heading_rad = heading_deg * std::numbers::pi / 180;
    word.heading = heading_deg;
    word.pitch = word.roll = 0;
    word.x = 19 * std::cos(heading_rad) + 3;
    word.y = -19 * std::sin(heading_rad);
    word.z = 44;
    const auto bytes = protocols::tcm2::encode_word(word);
    daemon.line.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    ::usleep(10'000);
    if (i % 50 == 49) forced = ask(control, force);
  }
  ASSERT_EQ(forced["ok"], true) << forced;
  EXPECT_NE(forced["name"], "none");
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  const auto all = this->calib();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const json& one) {
    return one["class"] == "CALIBRATION" && one["cause"] == "force" && one["in_force"].contains("magnetometer");
  }));
}

TEST_F(CalibrationProcess, ADamagedStateIsToldAndNeverFatal) {
  {
    DaemonProcess daemon(settings());
    daemon.wait_until_ready();
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
  }
  ASSERT_TRUE(std::filesystem::exists(state()));
  {
    DaemonProcess daemon(settings());
    daemon.wait_until_ready();
    EXPECT_EQ(daemon.stop(SIGTERM), 0);
    EXPECT_EQ(daemon.diagnostics().find("begin anew"), std::string::npos) << "a good state is simply taken";
  }
  std::fstream(state(), std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('!').put('?');
  DaemonProcess daemon(settings());
  daemon.wait_until_ready();
  EXPECT_EQ(daemon.stop(SIGTERM), 0);
  EXPECT_NE(daemon.diagnostics().find("its checksum is wrong"), std::string::npos) << daemon.diagnostics();
  EXPECT_TRUE(std::filesystem::exists(state().string() + ".damaged"));
  EXPECT_TRUE(std::filesystem::exists(state())) << "a good one is kept again";
}

TEST_F(CalibrationProcess, KilledAtAnyInstantItsStateIsWhole) {
  for (int round = 0; round < 4; ++round) {
    DaemonProcess daemon(settings());
    daemon.wait_until_ready();
    Client control(daemon.folder() / "control");
    for (int i = 0; i < 5 + round; ++i)
      EXPECT_EQ(ask(control, R"({"command":"calibration.start","calibrator":"magnetometer"})")["ok"], true);
    daemon.stop(SIGKILL);
    EXPECT_EQ(daemon.diagnostics().find("begin anew"), std::string::npos) << daemon.diagnostics();
  }
  EXPECT_FALSE(std::filesystem::exists(state().string() + ".damaged"));
}

}  // namespace
}  // namespace navcal::daemon
