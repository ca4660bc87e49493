// SPDX-License-Identifier: Apache-2.0
// The user calibration of a PNI compass, through a running navcald.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "protocols/trax.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;
namespace trax = protocols::trax;

/// The compass at the other end of the line: answers, and takes a sample whenever it is asked to serve.
class PniAtLine {
 public:
  explicit PniAtLine(const FakeLine& line) : line_(line) {}

  /// Hears and speaks until a frame of this number has come. False when it did not come.
  bool serve_until(int number, int rounds = 2000) {
    trax::Data data;
    data.heading_deg = 90;
    for (int i = 0; i < rounds; ++i) {
      if (hear(number)) return true;
      if (calibrating_) sample();
      if (going_) say(trax::encode_data(data));
    }
    return false;
  }

 private:
  void say(const std::vector<std::uint8_t>& bytes) {
    line_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  bool hear(int wanted) {
    const std::string text = line_.read(10);
    bool found = false;
    parser_.feed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                 [&](const protocols::Frame& frame) {
                   obey(frame.bytes);
                   found = found || frame.bytes[2] == wanted;
                 });
    return found;
  }
  void obey(protocols::Bytes frame) {
    switch (static_cast<trax::FrameNumber>(frame[2])) {
      case trax::FrameNumber::set_config: return say(trax::encode_frame(trax::FrameNumber::set_config_done));
      case trax::FrameNumber::start_calibration:
        if (!calibrating_) samples_ = 0;
        calibrating_ = true;
        return say(trax::encode_sample_count(samples_));
      case trax::FrameNumber::stop_calibration: calibrating_ = false; return;
      case trax::FrameNumber::save: {
        constexpr std::uint8_t kNoError[] = {0, 0};
        return say(trax::encode_frame(trax::FrameNumber::save_done, kNoError));
      }
      case trax::FrameNumber::start_continuous: going_ = true; return;
      case trax::FrameNumber::stop_continuous: going_ = false; return;
      default: return;
    }
  }
  void sample() {
    say(trax::encode_sample_count(++samples_));
    if (samples_ < 12) return;
    calibrating_ = false;
    say(trax::encode_score({0.5, 0, 1.25, 2, 0.75, 40}));
  }

  const FakeLine& line_;
  trax::Parser parser_;
  bool going_ = true, calibrating_ = false;
  std::uint32_t samples_ = 0;
};

class PniProcess : public testing::Test {
 protected:
  PniProcess()
      : daemon_({"--set", "port.compass.protocol=pni", "--set", "port.compass.start_up=false", "--set",
                 "status.health_interval_s=0.1"}) {
    daemon_.wait_until_ready();
    control_.emplace(daemon_.folder() / "control");
    watcher_.emplace(daemon_.port());
    watcher_->send("?WATCH={\"enable\":true,\"json\":true};\n");
  }
  json ask(const std::string& command) {
    control_->send(json{{"command", command}, {"calibrator", "pni"}}.dump() + "\n");
    return json::parse(control_->line().value());
  }
  json reported() { return json::parse(watcher_->line_with("\"pni\":"))["pni"]; }
  /// The report whose state first contains `words`; else the last one.
  json reported_with(PniAtLine& compass, const std::string& words) {
    json pni = reported();
    for (int i = 0; i < 300 && pni["state"].get<std::string>().find(words) == std::string::npos; ++i) {
      compass.serve_until(0, 20);
      pni = reported();
    }
    return pni;
  }

  DaemonProcess daemon_;
  std::optional<Client> control_, watcher_;
};

TEST_F(PniProcess, ItsScoreStandsBesideOursAndIsSavedOnOrder) {
  EXPECT_EQ(reported()["state"], "not begun");
  EXPECT_EQ(ask("calibration.accept")["error"], "there is no result that the compass could keep");
  PniAtLine compass(daemon_.line);
  EXPECT_EQ(ask("calibration.start")["ok"], true);
  ASSERT_TRUE(compass.serve_until(10));
  ASSERT_TRUE(compass.serve_until(21));
  const json pni = reported_with(compass, "kept until");
  EXPECT_EQ(pni["score"], (json{{"magnetometer", 0.5},
                                {"accelerometer", 1.25},
                                {"distribution_error", 2},
                                {"tilt_error", 0.75},
                                {"tilt_range_deg", 40}}));
  json accepted = json::object();
  // The score is known before the compass is back in service.
  for (int i = 0; i < 100 && accepted.value("ok", false) == false; ++i) {
    accepted = ask("calibration.accept");
    compass.serve_until(9, 20);
  }
  EXPECT_EQ(accepted["ok"], true) << accepted;
  EXPECT_NE(reported_with(compass, "saved")["state"].get<std::string>().find("saved"), std::string::npos);
}

TEST_F(PniProcess, OrdersThatMakeNoSenseAreRefused) {
  EXPECT_EQ(ask("calibration.stop")["error"], "the compass is not calibrating itself");
  EXPECT_EQ(ask("calibration.rollback")["ok"], false);
  EXPECT_EQ(ask("calibration.start")["ok"], true);
  EXPECT_NE(ask("calibration.start")["error"].get<std::string>().find("under way"), std::string::npos);
  EXPECT_EQ(ask("calibration.stop")["ok"], true);
  PniAtLine compass(daemon_.line);
  ASSERT_TRUE(compass.serve_until(21));
  EXPECT_NE(reported_with(compass, "failed")["state"].get<std::string>().find("called off"), std::string::npos);
}

}  // namespace
}  // namespace navcal::daemon
