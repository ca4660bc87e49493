// SPDX-License-Identifier: Apache-2.0
// The TCM2's calibration of itself, through a running navcald.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "protocols/tcm2_word.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

/// The compass at the other end of the line: obeys, and turns by 30 degrees from word to word.
class Compass {
 public:
  explicit Compass(const FakeLine& line) : line_(line) {}

  /// Hears and speaks until `command` has come, or for so many words. False when it did not come.
  bool serve_until(const std::string& command, int words = 2000) {
    for (int i = 0; i < words; ++i) {
      if (hear(command)) return true;
      if (going_) speak();
    }
    return false;
  }
  /// Everything that it was told, each command closed by a blank. One that follows itself stands once: navcald
  /// repeats what is not answered in time, and a loaded machine may not be in time (the exact dialogue is
  /// tests/instruments/tcm2_calibration_test.cpp's).
  [[nodiscard]] const std::string& heard() const { return heard_; }

 private:
  bool hear(const std::string& wanted) {
    received_ += line_.read(10);
    bool found = false;
    for (auto end = received_.find('\r'); end != std::string::npos; end = received_.find('\r')) {
      const std::string command = received_.substr(0, end);
      received_.erase(0, end + 1);
      if (command != last_) heard_ += command + ' ';
      last_ = command;
      going_ = command == "go" || (going_ && command != "h");
      line_.write(command == "cc" ? "H0V0M0.00\r\n" : command == "mpcal=d" ? "H9V3M1.20\r\n" : ":\r\n");
      found = found || command == wanted;
    }
    return found;
  }
  void speak() {
    heading_deg_ = heading_deg_ < 330 ? heading_deg_ + 30 : 0;
    protocols::tcm2::Word word;
    word.heading = heading_deg_;
    const auto bytes = protocols::tcm2::encode_word(word);
    line_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  const FakeLine& line_;
  std::string received_, heard_, last_;
  bool going_ = true;
  double heading_deg_ = 0;
};

class Tcm2Process : public testing::Test {
 protected:
  Tcm2Process()
      : daemon_({"--set", "port.compass.protocol=tcm2", "--set", "port.compass.start_up=false", "--set",
                 "status.health_interval_s=0.1"}) {
    daemon_.wait_until_ready();
    control_.emplace(daemon_.folder() / "control");
    watcher_.emplace(daemon_.port());
    watcher_->send("?WATCH={\"enable\":true,\"json\":true};\n");
  }
  json ask(const std::string& command) {
    control_->send(json{{"command", command}, {"calibrator", "tcm2"}}.dump() + "\n");
    return json::parse(control_->line().value());
  }
  json reported() { return json::parse(watcher_->line_with("\"tcm2\":"))["tcm2"]; }

  DaemonProcess daemon_;
  std::optional<Client> control_, watcher_;
};

TEST_F(Tcm2Process, ItsScoreStandsBesideOurs) {
  EXPECT_EQ(reported()["state"], "not begun");
  Compass compass(daemon_.line);
  EXPECT_EQ(ask("calibration.start")["ok"], true);
  ASSERT_TRUE(compass.serve_until("mpcal=d")) << compass.heard();
  ASSERT_TRUE(compass.serve_until("go")) << compass.heard();
  // The score is known before the compass is back in service, and a report may fall between the two.
  json tcm2 = reported();
  for (int i = 0; i < 300 && tcm2["state"] != "score H9V3M1.20"; ++i) {
    compass.serve_until("nothing", 20);
    tcm2 = reported();
  }
  EXPECT_EQ(compass.heard(), "h cc mpcal=e go h mpcal=d go ");
  EXPECT_EQ(tcm2["state"], "score H9V3M1.20");
  EXPECT_EQ(tcm2["score"], (json{{"horizontal", 9}, {"vertical", 3}, {"magnitude", 1.2}}));
}

TEST_F(Tcm2Process, OrdersThatMakeNoSenseAreRefused) {
  EXPECT_EQ(ask("calibration.stop")["error"], "the compass is not calibrating itself");
  EXPECT_EQ(ask("calibration.accept")["ok"], false);
  EXPECT_EQ(ask("calibration.rollback")["ok"], false);
  EXPECT_EQ(ask("calibration.start")["ok"], true);
  EXPECT_NE(ask("calibration.start")["error"].get<std::string>().find("under way"), std::string::npos);
  EXPECT_EQ(ask("calibration.stop")["ok"], true);
  Compass compass(daemon_.line);
  ASSERT_TRUE(compass.serve_until("go")) << compass.heard();
}

}  // namespace
}  // namespace navcal::daemon
