// SPDX-License-Identifier: Apache-2.0
// The operator's commands to an instrument, through a running navcald.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "record/recording.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

class DeviceCommandProcess : public testing::Test {
 protected:
  void start(const std::string& protocol, bool start_up = false) {
    daemon_.emplace(
        std::vector<std::string>{"--set", "port.compass.protocol=" + protocol, "--set",
                                 start_up ? "port.compass.start_up=true" : "port.compass.start_up=false"});
    daemon_->wait_until_ready();
    control_.emplace(daemon_->folder() / "control");
  }
  json ask(const json& request) {
    control_->send(request.dump() + "\n");
    return json::parse(control_->line().value());
  }
  json give(const std::string& name, bool force = false) {
    return ask({{"command", "device.command"}, {"port", "compass"}, {"name", name}, {"force", force}});
  }
  json listed() { return ask({{"command", "device.commands"}})["ports"][0]; }
  /// The newest command, once it is over.
  json outcome() {
    json last = listed()["last"];
    for (int i = 0; i < 4000 && last["state"] == "under way"; ++i) {
      ::usleep(5000);
      last = listed()["last"];
    }
    return last;
  }
  /// What the daemon says, up to `end`.
  std::string heard_until(const std::string& end) {
    std::string heard;
    for (int i = 0; i < 2000 && heard.find(end) == std::string::npos; ++i) heard += daemon_->line.read(10);
    return heard;
  }

  std::optional<DaemonProcess> daemon_;
  std::optional<Client> control_;
};

TEST_F(DeviceCommandProcess, TheAnswerIsGivenToldAndLogged) {
  start("tcm2");
  EXPECT_EQ(listed()["last"], nullptr);
  EXPECT_EQ(listed()["commands"][1]["name"], "calibration_score");
  EXPECT_EQ(listed()["commands"][1]["force"], false);
  const json given = give("calibration_score");
  EXPECT_EQ(given, (json{{"ok", true}, {"number", 1}}));
  EXPECT_EQ(heard_until("\r"), "lc?\r");
  daemon_->line.write("H9V3M1.20\r\n");
  EXPECT_EQ(outcome(),
            (json{{"name", "calibration_score"}, {"number", 1}, {"state", "done"}, {"answer", "H9V3M1.20"}}));
  EXPECT_EQ(daemon_->stop(SIGTERM), 0);
  const auto recording = record::Recording::open(daemon_->logs().front().string());
  std::string sent, events;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry); raw && raw->direction == record::Direction::sent)
      sent.append(raw->bytes.begin(), raw->bytes.end());
    if (const auto* event = std::get_if<record::LoggedEvent>(&*entry)) events += event->json + "\n";
  }
  EXPECT_NE(sent.find("lc?\r"), std::string::npos);
  EXPECT_NE(events.find("calibration_score: given by the operator"), std::string::npos) << events;
  EXPECT_NE(events.find("calibration_score: H9V3M1.20"), std::string::npos) << events;
}

TEST_F(DeviceCommandProcess, NothingIsSentOfWhatIsRefused) {
  start("tcm2");
  EXPECT_EQ(give("format")["error"],
            "compass has no command format; it has restart_stream, calibration_score, restart");
  EXPECT_EQ(ask({{"command", "device.command"}, {"port", "gps"}, {"name", "receiver_id"}})["error"],
            "there is no port gps");
  EXPECT_EQ(ask({{"command", "device.commands"}, {"port", "navigation"}})["error"], "there is no port navigation");
  EXPECT_NE(give("restart")["error"].get<std::string>().find("it needs force"), std::string::npos);
  EXPECT_EQ(daemon_->line.read(100), "");
  EXPECT_EQ(give("restart", true)["ok"], true);
  EXPECT_EQ(heard_until("\r"), "ax\r");
  EXPECT_EQ(give("calibration_score")["error"], "restart is under way");
  EXPECT_EQ(ask({{"command", "calibration.start"}, {"calibrator", "tcm2"}})["error"], "restart is under way");
  daemon_->line.write("TCM2 2.6\r\n");
  EXPECT_EQ(outcome()["answer"], "TCM2 2.6");
}

TEST_F(DeviceCommandProcess, NeitherStartUpNorCalibrationIsDisturbed) {
  start("tcm2", true);
  EXPECT_EQ(give("calibration_score")["error"].get<std::string>().find("the start-up dialogue is under way: "),
            0U);
  start("tcm2");
  EXPECT_EQ(ask({{"command", "calibration.start"}, {"calibrator", "tcm2"}})["ok"], true);
  EXPECT_EQ(give("restart_stream")["error"].get<std::string>().find("the compass calibrates itself: "), 0U);
}

TEST_F(DeviceCommandProcess, ADeviceThatTakesNone) {
  start("nmea");
  EXPECT_EQ(give("restart")["error"], "a device of protocol nmea takes no commands");
  EXPECT_EQ(listed()["commands"], json::array());
}

}  // namespace
}  // namespace navcal::daemon
