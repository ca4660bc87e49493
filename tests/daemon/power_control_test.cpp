// SPDX-License-Identifier: Apache-2.0
// Switched supplies: a line that a test holds, and sessions on pseudo-terminals.
#include "daemon/power_control.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "config/load.h"
#include "tests/daemon/daemon_process.h"

namespace navcal::daemon {
namespace {

using nlohmann::json;

/// A line without a kernel.
struct LineState {
  std::optional<bool> on;
  std::string problem;  ///< of each switching
  int opened = 0;
};
class TestLine final : public PowerLine {
 public:
  explicit TestLine(LineState& state) : state_(state) {}
  [[nodiscard]] std::optional<bool> is_on() const override { return state_.on; }
  [[nodiscard]] std::string set(bool on) override {
    if (state_.problem.empty()) state_.on = on;
    return state_.problem;
  }

 private:
  LineState& state_;
};

class PowerControlTest : public testing::Test, protected PortOwner, protected PowerOwner {
 protected:
  void make(config::PowerAtStart at_start, double settle_s = 0.05) {
    settings_.ports = {config::default_port("gps", protocols::Protocol::oncore, 9600)};
    settings_.ports[0].path = line_.path();
    config::PowerSettings supply;
    supply.name = "mast";
    supply.gpio_chip = "gpiochip0";
    supply.line = 3;
    supply.devices = {"gps"};
    supply.at_start = at_start;
    supply.settle_s = settle_s;
    settings_.power = {supply};
    PortOwner& owner = *this;
    sessions_.push_back(std::make_unique<PortSession>(context_.get_executor(), 0, settings_.ports[0], owner));
    PowerOwner& power_owner = *this;
    power_ = std::make_unique<PowerControl>(
        context_.get_executor(), settings_, sessions_, power_owner,
        [this](const config::PowerSettings& asked, std::string& problem) -> std::unique_ptr<PowerLine> {
          ++state_.opened;
          if (!can_open_) {
            problem = "no such chip";
            return nullptr;
          }
          if (asked.at_start != config::PowerAtStart::leave)
            state_.on = asked.at_start == config::PowerAtStart::on;
          return std::make_unique<TestLine>(state_);
        });
    power_->begin(ports::monotonic_ns());
    session().start();
  }
  ~PowerControlTest() override {
    if (power_) power_->stop();
    for (const auto& one : sessions_) one->stop();
    context_.run();
  }
  PortSession& session() { return *sessions_.front(); }
  json ask(ControlCommand command, const std::string& name = "mast") {
    ControlRequest request;
    request.command = command;
    request.name = name;
    return json::parse(power_->answer(request));
  }
  template <class Condition>
  bool eventually(Condition condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      context_.run_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  bool hears_the_start_up() {
    return eventually([&] { return !line_.read(0).empty(); });
  }
  bool is_in(PortSession::State state) {
    return eventually([&] { return session().state() == state; });
  }

  void on_port_bytes(std::uint16_t, std::int64_t, protocols::Bytes) override {}
  void on_port_sent(std::uint16_t, std::int64_t, protocols::Bytes) override {}
  void on_port_event(std::uint16_t, std::int64_t, std::string_view severity, std::string_view name,
                     std::string_view) override {
    if (severity == "warning") warnings_.emplace_back(name);
  }
  void on_port_changed(std::uint16_t) override {}
  void on_compass_calibrated(std::uint16_t, std::int64_t, const instruments::CompassCalibration&) override {}
  [[nodiscard]] std::optional<instruments::ReceiverAid> receiver_aid(std::int64_t) const override { return {}; }
  void on_power_event(std::int64_t, std::string_view, std::string_view name, std::string_view) override {
    events_.emplace_back(name);
  }
  [[nodiscard]] std::string why_power_stays(std::uint16_t) const override { return why_stays_; }

  boost::asio::io_context context_;
  FakeLine line_;
  config::Settings settings_;
  LineState state_;
  bool can_open_ = true;
  std::string why_stays_;
  std::vector<std::string> events_, warnings_;
  PowerControl::Sessions sessions_;
  std::unique_ptr<PowerControl> power_;
};

TEST_F(PowerControlTest, ADeviceThatIsSwitchedOffIsOffAndIsSpokenToAgainAfterSwitchingOn) {
  make(config::PowerAtStart::on);
  ASSERT_TRUE(is_in(PortSession::State::running));
  ASSERT_TRUE(hears_the_start_up());
  EXPECT_EQ(ask(ControlCommand::power_off)["on"], false);
  EXPECT_EQ(state_.on, false);
  EXPECT_EQ(session().state(), PortSession::State::off);
  EXPECT_FALSE(session().open_port());
  EXPECT_FALSE(session().send_now(std::vector<std::uint8_t>{1}));
  // What was on its way already leaves.
  context_.run_for(std::chrono::milliseconds(50));
  while (!line_.read(50).empty()) {
  }
  // Long after it would be silent, and nothing is sent to it.
  session().tick(ports::monotonic_ns() + 60'000'000'000, {});
  context_.run_for(std::chrono::milliseconds(50));
  EXPECT_EQ(session().state(), PortSession::State::off);
  EXPECT_EQ(line_.read(0), "");
  EXPECT_EQ(ask(ControlCommand::power_list)["supplies"][0]["on"], false);
  EXPECT_EQ(ask(ControlCommand::power_on)["on"], true);
  EXPECT_EQ(session().state(), PortSession::State::off) << "until it has settled";
  ASSERT_TRUE(is_in(PortSession::State::running));
  EXPECT_TRUE(hears_the_start_up());
  EXPECT_EQ(events_, (std::vector<std::string>{"power.off", "power.on"}));
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(PowerControlTest, SwitchingOffWhileItSettlesLeavesItOff) {
  make(config::PowerAtStart::off, 0.1);
  ASSERT_EQ(ask(ControlCommand::power_on)["ok"], true);
  ASSERT_EQ(ask(ControlCommand::power_off)["ok"], true);
  context_.run_for(std::chrono::milliseconds(300));
  EXPECT_EQ(session().state(), PortSession::State::off);
}

TEST_F(PowerControlTest, WhatIsLeftAsItIsIsNotTouched) {
  state_.on = false;
  make(config::PowerAtStart::leave);
  EXPECT_EQ(state_.on, false);
  EXPECT_EQ(session().state(), PortSession::State::off);
}

TEST_F(PowerControlTest, ALineOfUnknownStateCountsAsOnUntilItIsSwitched) {
  make(config::PowerAtStart::leave);
  ASSERT_TRUE(is_in(PortSession::State::running));
  EXPECT_EQ(ask(ControlCommand::power_list)["supplies"][0]["on"], nullptr);
  EXPECT_EQ(ask(ControlCommand::power_off)["ok"], true);
  EXPECT_EQ(state_.on, false);
}

TEST_F(PowerControlTest, RefusalsSayWhy) {
  make(config::PowerAtStart::on, 0);
  ASSERT_TRUE(is_in(PortSession::State::running));
  EXPECT_EQ(ask(ControlCommand::power_off, "masts")["error"], "there is no supply masts; power.list has them");
  why_stays_ = "pilot holds the motor card";
  EXPECT_EQ(ask(ControlCommand::power_off)["error"], why_stays_);
  EXPECT_EQ(state_.on, true);
  EXPECT_EQ(ask(ControlCommand::power_on)["ok"], true) << "on is always allowed";
  why_stays_.clear();
  state_.problem = "Input/output error";
  EXPECT_EQ(ask(ControlCommand::power_off)["error"], state_.problem);
  EXPECT_NE(session().state(), PortSession::State::off) << "it has its supply still";
}

TEST_F(PowerControlTest, ALineThatCannotBeTakenIsTriedAgainWhenItIsSwitched) {
  can_open_ = false;
  make(config::PowerAtStart::off);
  EXPECT_EQ(events_, std::vector<std::string>{"power.failed"});
  EXPECT_EQ(ask(ControlCommand::power_off)["error"], "no such chip");
  EXPECT_EQ(ask(ControlCommand::power_list)["supplies"][0]["problem"], "no such chip");
  can_open_ = true;
  EXPECT_EQ(ask(ControlCommand::power_off)["ok"], true);
  EXPECT_EQ(session().state(), PortSession::State::off);
  EXPECT_EQ(ask(ControlCommand::power_list)["supplies"][0]["problem"], "");
}

TEST(GpioLine, AControllerThatIsNotThereIsAProblemInWords) {
  config::PowerSettings supply;
  supply.gpio_chip = "gpiochip9999";
  supply.line = 0;
  std::string problem;
  EXPECT_EQ(open_gpio_line(supply, problem), nullptr);
  EXPECT_NE(problem.find("gpiochip9999 line 0: the controller cannot be opened"), std::string::npos) << problem;
}

/// Needs a simulated controller (module gpio-sim) or a spare line of a real one.
TEST(GpioLine, ARealLineIsSwitched) {
  const char* const chip = std::getenv("NAVCAL_TEST_GPIOCHIP");
  if (chip == nullptr || !std::filesystem::exists(std::string("/dev/") + chip))
    GTEST_SKIP() << "NAVCAL_TEST_GPIOCHIP names no GPIO controller whose line 0 may be switched";
  config::PowerSettings supply;
  supply.gpio_chip = chip;
  supply.line = 0;
  std::string problem;
  const auto line = open_gpio_line(supply, problem);
  ASSERT_NE(line, nullptr) << problem;
  EXPECT_EQ(line->is_on(), true);
  for (const bool on : {false, true, false}) {
    EXPECT_EQ(line->set(on), "");
    EXPECT_EQ(line->is_on(), on);
  }
}

}  // namespace
}  // namespace navcal::daemon
