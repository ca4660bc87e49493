// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

constexpr const char* kSettings = "uc=d ui=d ut=c ec=e ep=e er=e em=e et=e sdo=t ";

config::PortSettings compass() {
  config::PortSettings port;
  port.name = "compass";
  port.protocol = protocols::Protocol::tcm2;
  return port;
}

/// A device that accepts everything and, once told to go, sends ten words a second while `on`.
struct Compass {
  bool on = true;
  bool going = false;

  Dialogue::Device device() {
    return [this](Dialogue& dialogue, const std::string& command) {
      if (!on) return;
      going = command == "go\r" || (going && command != "h\r");
      dialogue.answer("REPLY", ":\r\n");
    };
  }
  std::function<void()> words(Dialogue& dialogue) {
    return [this, &dialogue] {
      if (on && going && dialogue.now_ns() % (100 * base::kMillisecond_ns) == 0) dialogue.frame("WORD");
    };
  }
};

TEST(StartUpTcm2, HaltsTwiceSetsAndGoes) {
  Compass compass_device;
  Dialogue dialogue(make_start_up(compass()), compass_device.device());
  dialogue.begin();
  dialogue.run_for(10 * base::kSecond_ns, compass_device.words(dialogue));
  EXPECT_EQ(dialogue.transcript(), std::string("h h ") + kSettings + "go ");
  EXPECT_EQ(dialogue.sent[1].at_ns - dialogue.sent[0].at_ns, 100 * base::kMillisecond_ns);
  EXPECT_EQ(dialogue.state(), "running");
  EXPECT_LT(dialogue.sent.back().at_ns - dialogue.sent.front().at_ns, base::kSecond_ns)
      << "a willing device starts at once";
}

TEST(StartUpTcm2, SaysNothingBeforeItBegins) {
  Dialogue dialogue(make_start_up(compass()));
  dialogue.frame("BANNER");
  dialogue.frame("WORD");
  dialogue.run_for(20 * base::kSecond_ns);
  EXPECT_TRUE(dialogue.sent.empty());
  EXPECT_EQ(dialogue.start_up().deadline_ns(), INT64_MAX);
}

TEST(StartUpTcm2, UnitsAndRateComeFromTheConfiguration) {
  auto port = compass();
  port.compass = {config::AngleUnit::mils, config::AngleUnit::mils, config::TemperatureUnit::F};
  const std::pair<double, const char*> kRates[] = {{10, "clock=10 sp=1 "},
                                                   {5, "clock=25 sp=5 "},
                                                   {3, "clock=9 sp=3 "},
                                                   {2.5, "clock=5 sp=2 "},
                                                   {40, "clock=40 sp=1 "}};
  for (const auto& [rate_Hz, expected] : kRates) {
    port.rate_Hz = rate_Hz;
    Compass compass_device;
    Dialogue dialogue(make_start_up(port), compass_device.device());
    dialogue.begin();
    dialogue.run_for(3 * base::kSecond_ns, compass_device.words(dialogue));
    EXPECT_EQ(dialogue.transcript(),
              std::string("h h uc=m ui=m ut=f ec=e ep=e er=e em=e et=e sdo=t ") + expected + "go ");
  }
}

TEST(StartUpTcm2, ARefusalIsRecordedAndCostsNothing) {
  auto port = compass();
  port.rate_Hz = 10;
  Dialogue dialogue(make_start_up(port), [](Dialogue& d, const std::string& command) {
    d.answer("REPLY", command.starts_with("clock") ? ":E040\r\n" : ":\r\n");
    if (command == "go\r") d.answer("WORD");
  });
  dialogue.begin();
  dialogue.run_for(2 * base::kSecond_ns);
  EXPECT_EQ(dialogue.transcript(), std::string("h h ") + kSettings + "clock=10 sp=1 go ");
  EXPECT_EQ(dialogue.state(), "running; refused: clock=10 (E040)");
}

TEST(StartUpTcm2, AnUnansweredSettingIsRepeatedTwiceThenNamed) {
  Dialogue dialogue(make_start_up(compass()), [](Dialogue& d, const std::string& command) {
    if (command != "et=e\r") d.answer("REPLY", ":\r\n");
    if (command == "go\r") d.answer("WORD");
  });
  dialogue.begin();
  dialogue.run_for(4 * base::kSecond_ns);
  EXPECT_EQ(dialogue.transcript(), "h h uc=d ui=d ut=c ec=e ep=e er=e em=e et=e et=e et=e sdo=t go ");
  EXPECT_EQ(dialogue.state(), "running; no answer to: et=e");
}

TEST(StartUpTcm2, ADeviceThatNeverRepliesIsStillStarted) {
  Dialogue dialogue(make_start_up(compass()), [](Dialogue& d, const std::string& command) {
    if (command == "go\r") d.answer("WORD");
  });
  dialogue.begin();
  dialogue.run_for(7 * base::kSecond_ns);
  EXPECT_EQ(dialogue.transcript(), "h h uc=d uc=d uc=d ui=d ut=c ec=e ep=e er=e em=e et=e sdo=t go ");
  EXPECT_TRUE(never_repeated_within(dialogue.sent, 100 * base::kMillisecond_ns));
}

TEST(StartUpTcm2, RepliesToTheHaltsAnswerNoSetting) {
  Dialogue dialogue(make_start_up(compass()), [](Dialogue& d, const std::string& command) {
    if (command == "h\r") d.answer("REPLY", ":\r\n", 150 * base::kMillisecond_ns);
  });
  dialogue.begin();
  dialogue.run_for(650 * base::kMillisecond_ns);
  EXPECT_EQ(dialogue.transcript(), "h h uc=d ");
}

TEST(StartUpTcm2, AValueOfAnotherParameterAnswersNoSetting) {
  Dialogue dialogue(make_start_up(compass()));
  dialogue.begin();
  dialogue.run_for(350 * base::kMillisecond_ns);
  dialogue.frame("REPLY", ":ec=e\r\n");
  dialogue.frame("REPLY", "H9V9M1.0\r\n");
  EXPECT_EQ(dialogue.state(), "setting uc=d (1 of 9)");
  dialogue.frame("REPLY", ":uc=d\r\n");
  EXPECT_EQ(dialogue.state(), "setting ui=d (2 of 9)");
}

TEST(StartUpTcm2, BeginsAgainAfterABanner) {
  Compass compass_device;
  Dialogue dialogue(make_start_up(compass()), compass_device.device());
  dialogue.begin();
  dialogue.run_for(5 * base::kSecond_ns, compass_device.words(dialogue));
  dialogue.sent.clear();
  compass_device.going = false;
  dialogue.frame("BANNER", "TCM2.5\r\n");
  dialogue.run_for(2 * base::kSecond_ns, compass_device.words(dialogue));
  EXPECT_EQ(dialogue.transcript(), std::string("h h ") + kSettings + "go ");
  EXPECT_EQ(dialogue.state(), "running");
}

TEST(StartUpTcm2, APowerCycleWithoutBannerIsNoticedByTheSilence) {
  Compass compass_device;
  Dialogue dialogue(make_start_up(compass()), compass_device.device());
  dialogue.begin();
  dialogue.run_for(5 * base::kSecond_ns, compass_device.words(dialogue));
  dialogue.sent.clear();
  compass_device.on = compass_device.going = false;
  dialogue.run_for(2900 * base::kMillisecond_ns, compass_device.words(dialogue));
  EXPECT_TRUE(dialogue.sent.empty());
  dialogue.run_for(30 * base::kSecond_ns, compass_device.words(dialogue));
  EXPECT_NE(dialogue.state().find("no words came so far"), std::string::npos) << dialogue.state();
  compass_device.on = true;
  dialogue.run_for(20 * base::kSecond_ns, compass_device.words(dialogue));
  EXPECT_EQ(dialogue.state(), "running");
}

TEST(StartUpTcm2, NeverFloodsADeadDevice) {
  Dialogue dialogue(make_start_up(compass()));
  dialogue.begin();
  dialogue.run_for(600 * base::kSecond_ns);
  EXPECT_TRUE(never_repeated_within(dialogue.sent, 100 * base::kMillisecond_ns));
  std::vector<std::int64_t> started;
  for (const Sent& command : dialogue.sent) {
    if (command.text == "go\r") started.push_back(command.at_ns);
  }
  ASSERT_GT(started.size(), 30U) << "and never gives up";
  for (std::size_t i = 4; i < started.size(); ++i) EXPECT_GE(started[i] - started[i - 1], 10 * base::kSecond_ns);
  EXPECT_LT(dialogue.sent.size(), 600U) << "less than one command a second";
}

TEST(StartUpTcm2, BannersWithoutEndCauseNoFlood) {
  Dialogue dialogue(make_start_up(compass()));
  dialogue.begin();
  dialogue.run_for(10 * base::kSecond_ns, [&] {
    if (dialogue.now_ns() % (250 * base::kMillisecond_ns) == 0) dialogue.frame("BANNER");
  });
  EXPECT_TRUE(never_repeated_within(dialogue.sent, 100 * base::kMillisecond_ns));
  EXPECT_LE(dialogue.sent.size(), 50U);
}

TEST(StartUpTcm2, ASlowRateIsNoSilence) {
  auto port = compass();
  port.rate_Hz = 0.2;
  Dialogue dialogue(make_start_up(port), [](Dialogue& d, const std::string&) { d.answer("REPLY", ":\r\n"); });
  dialogue.begin();
  const auto words = [&] {
    if (dialogue.now_ns() % (5 * base::kSecond_ns) == 0) dialogue.frame("WORD");
  };
  dialogue.run_for(12 * base::kSecond_ns, words);
  const std::size_t sent = dialogue.sent.size();
  dialogue.run_for(60 * base::kSecond_ns, words);
  EXPECT_EQ(dialogue.sent.size(), sent);
  EXPECT_EQ(dialogue.state(), "running");
}

TEST(StartUp, OnlyDevicesThatTakeCommandsAreTalkedTo) {
  auto port = compass();
  EXPECT_NE(make_start_up(port), nullptr);
  port.start_up = false;
  EXPECT_EQ(make_start_up(port), nullptr);
  port.start_up = true;
  for (const auto protocol :
       {protocols::Protocol::imu_card, protocols::Protocol::motor_card, protocols::Protocol::nmea}) {
    port.protocol = protocol;
    EXPECT_EQ(make_start_up(port), nullptr);
  }
}

}  // namespace
}  // namespace navcal::instruments::test
