// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "config/load.h"
#include "protocols/vectornav_lines.h"
#include "tests/instruments/collector.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

namespace vn = protocols::vectornav;

/// A sensor at one of its ports. Set what it cannot do.
struct FakeSensor {
  int port = 1;
  bool has_errors = true, has_binary = true, is_silent = false, fits = true;
  int damaged = 0;  ///< commands that arrive damaged
  int deaf_to = 0;  ///< commands that it does not hear
  bool sends_binary = false, sends_lines = true;
  std::vector<std::string> asked;

  void operator()(Dialogue& dialogue, const std::string& command) {
    const auto content =
        vn::decode_register({reinterpret_cast<const std::uint8_t*>(command.data()), command.size()});
    ASSERT_TRUE(content) << command;
    asked.push_back(command.substr(1, command.find('*') - 1));
    if (is_silent || deaf_to-- > 0) return;
    if (damaged-- > 0) return error(dialogue, 3);
    if (!content->write)
      return answer(dialogue, {false, content->number, content->number == 1 ? "VN-100T-CR" : "2.1.0.0"});
    if (content->number == vn::kAsyncType) sends_lines = content->values != "0";
    if (content->number == vn::kBinaryOutput1) {
      if (!has_binary) return error(dialogue, 8);
      if (!fits) return error(dialogue, 12);
      if (!has_errors && content->values.find("0100") != std::string::npos) return error(dialogue, 7);
      sends_binary = content->values.front() - '0' == port;
    }
    answer(dialogue, *content);
  }
  static void answer(Dialogue& dialogue, const vn::Register& content) {
    const auto line = vn::encode_register(content);
    dialogue.answer(content.write ? "VNWRG" : "VNRRG", {line.begin(), line.end()});
  }
  static void error(Dialogue& dialogue, std::uint8_t code) {
    const auto line = vn::encode_error(code);
    dialogue.answer("VNERR", {line.begin(), line.end()});
  }
};

struct VectorNavDialogue : testing::Test {
  FakeSensor sensor;
  std::unique_ptr<Dialogue> dialogue;

  void start(double rate_Hz = 40) {
    auto port = config::default_port("imu", protocols::Protocol::vectornav, 115200);
    port.rate_Hz = rate_Hz;
    dialogue = std::make_unique<Dialogue>(
        make_start_up(port), [this](Dialogue& running, const std::string& command) { sensor(running, command); });
    dialogue->begin();
  }
  void run(double seconds) {
    const std::string line = nmea("VNYMR,1,2,3,4,5,6,7,8,9,1,2,3");
    dialogue->run_for(static_cast<std::int64_t>(seconds * 1e9), [&] {
      if (dialogue->now_ns() % (25 * base::kMillisecond_ns) != 0) return;
      if (sensor.sends_binary) dialogue->frame("VNBIN");
      if (sensor.sends_lines && !sensor.sends_binary) dialogue->frame("VNYMR", line);
    });
  }
};

TEST_F(VectorNavDialogue, BinaryOutputIsTurnedOnInMemory) {
  start();
  run(2);
  EXPECT_EQ(sensor.asked,
            (std::vector<std::string>{"VNRRG,01", "VNRRG,04", "VNWRG,06,0", "VNWRG,75,1,20,11,0529,0100"}));
  EXPECT_EQ(dialogue->state(), "running on binary messages; VN-100T-CR, firmware 2.1.0.0");
  run(60);
  EXPECT_EQ(sensor.asked.size(), 4U);
  for (const auto& command : sensor.asked) EXPECT_EQ(command.find("VNWNV"), std::string::npos) << "never to flash";
}

TEST_F(VectorNavDialogue, TheRateIsAWholePartOfTheSensors) {
  start(100);
  run(1);
  EXPECT_EQ(sensor.asked.back(), "VNWRG,75,1,8,11,0529,0100");
}

TEST_F(VectorNavDialogue, TheOtherPortIsTriedWhenNothingComes) {
  sensor.port = 2;
  start();
  run(4);
  EXPECT_EQ(sensor.asked.back(), "VNWRG,75,2,20,11,0529,0100");
  EXPECT_TRUE(dialogue->state().starts_with("running on binary messages")) << dialogue->state();
}

TEST_F(VectorNavDialogue, OldFirmwareHasNoStandardDeviations) {
  sensor.has_errors = false;
  start();
  run(4);
  EXPECT_EQ(sensor.asked.back(), "VNWRG,75,1,20,01,0529");
  EXPECT_EQ(
      dialogue->state(),
      "running on binary messages; VN-100T-CR, firmware 2.1.0.0; refused: VNWRG,75,1,20,11,0529,0100 (invalid "
      "parameter), VNWRG,75,2,20,11,0529,0100 (invalid parameter)");
}

TEST_F(VectorNavDialogue, WithoutBinaryOutputItRunsOnLines) {
  sensor.has_binary = false;
  start(30);
  run(4);
  EXPECT_EQ(sensor.asked.back(), "VNWRG,06,14");
  EXPECT_EQ(sensor.asked[sensor.asked.size() - 2], "VNWRG,07,25") << "the nearest rate that it has";
  EXPECT_TRUE(dialogue->state().starts_with("running on lines; VN-100T-CR")) << dialogue->state();
}

TEST_F(VectorNavDialogue, ALineThatIsTooSlowIsSaid) {
  sensor.fits = false;
  start();
  run(4);
  EXPECT_NE(dialogue->state().find("(insufficient baud rate)"), std::string::npos) << dialogue->state();
}

TEST_F(VectorNavDialogue, LostAndDamagedCommandsAreRepeated) {
  sensor.deaf_to = 2;  // the questions
  sensor.damaged = 2;
  start();
  run(4);
  EXPECT_EQ(sensor.asked, (std::vector<std::string>{"VNRRG,01", "VNRRG,04", "VNWRG,06,0", "VNWRG,06,0",
                                                    "VNWRG,06,0", "VNWRG,75,1,20,11,0529,0100"}));
  EXPECT_EQ(dialogue->state(), "running on binary messages");
}

TEST_F(VectorNavDialogue, ADeafSensorIsUsedAsItIs) {
  sensor.is_silent = true;
  start();
  run(3);
  EXPECT_EQ(dialogue->state(), "running on lines; no answer to: VNWRG,06,0");
}

TEST_F(VectorNavDialogue, ASilentLineIsTriedAgainAndAgain) {
  sensor.is_silent = true;
  sensor.sends_lines = false;
  start();
  run(8);
  EXPECT_EQ(dialogue->state(),
            "no measurements come; trying again every 10 s, 1 so far; no answer to: VNWRG,06,0");
  run(30);
  EXPECT_TRUE(never_repeated_within(dialogue->sent, 250 * base::kMillisecond_ns));
  sensor.is_silent = false;
  sensor.sends_lines = true;
  run(15);
  EXPECT_TRUE(dialogue->state().starts_with("running on binary messages")) << dialogue->state();
}

TEST_F(VectorNavDialogue, AfterARestartItBeginsAnew) {
  start();
  run(3);
  sensor.sends_binary = false;  // its memory is that of the factory
  sensor.sends_lines = true;
  sensor.asked.clear();
  run(0.9);
  EXPECT_TRUE(sensor.asked.empty());
  run(3);
  EXPECT_EQ(sensor.asked.back(), "VNWRG,75,1,20,11,0529,0100");
  EXPECT_TRUE(dialogue->state().starts_with("running on binary messages")) << dialogue->state();
}

}  // namespace
}  // namespace navcal::instruments::test
