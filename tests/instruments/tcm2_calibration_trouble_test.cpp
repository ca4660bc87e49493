// SPDX-License-Identifier: Apache-2.0
// The calibration dialogue over a bad line, with a device that refuses, and through losses of power: it always
// ends, and the words always come back.
#include <gtest/gtest.h>

#include <map>

#include "tests/instruments/tcm2_calibration_bench.h"

namespace navcal::instruments::test {
namespace {

bool is_word(const std::string& line) { return line.front() == '$'; }

TEST(Tcm2CalibrationTrouble, AnyOneCommandMayBeLost) {
  for (const std::string lost : {"h", "cc", "mpcal=e", "go", "mpcal=d"}) {
    Tcm2CalibrationBench bench(36);
    bool first = true;
    bench.command_passes = [&](const std::string& command) {
      if (!first || command != lost + '\r') return true;
      return first = false;
    };
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(60 * base::kSecond_ns);
    EXPECT_FALSE(first) << lost;
    ASSERT_TRUE(bench.horizontal()) << lost << ": " << bench.dialogue.state();
    EXPECT_EQ(bench.horizontal(), 9) << lost;
    EXPECT_TRUE(bench.words_flow()) << lost;
  }
}

TEST(Tcm2CalibrationTrouble, AnyOneReplyMayBeLost) {
  for (int lost = 0; lost < 9; ++lost) {
    Tcm2CalibrationBench bench(36);
    int replies = 0;
    bench.line_passes = [&](const std::string& line) { return is_word(line) || replies++ != lost; };
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(60 * base::kSecond_ns);
    EXPECT_TRUE(bench.horizontal()) << lost << ": " << bench.dialogue.state();
    EXPECT_TRUE(bench.words_flow()) << lost;
  }
}

TEST(Tcm2CalibrationTrouble, ALostScoreIsAskedForAgain) {
  Tcm2CalibrationBench bench(36);
  int scores = 0;
  bench.line_passes = [&](const std::string& line) { return line.front() != 'H' || scores++ != 1; };
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(60 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), "h h cc mpcal=e go h h mpcal=d mpcal=d lc? go ");
  ASSERT_TRUE(bench.horizontal());
  EXPECT_EQ(bench.horizontal(), 9);
}

TEST(Tcm2CalibrationTrouble, ADeviceThatNeverRepliesIsPutBackToService) {
  Tcm2CalibrationBench bench;
  bench.line_passes = is_word;
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(60 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), "h h cc cc cc go ");
  EXPECT_EQ(bench.dialogue.state(), "failed: no answer to cc");
  EXPECT_TRUE(bench.words_flow());
}

TEST(Tcm2CalibrationTrouble, ADeadDeviceEndsItSoon) {
  Tcm2CalibrationBench bench;
  bench.line_passes = [](const std::string&) { return false; };
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(60 * base::kSecond_ns);
  EXPECT_FALSE(bench.dialogue.busy());
  EXPECT_EQ(bench.transcript(), "h h cc cc cc go go go ");
}

/// Answers a command by a refusal and keeps it from the device.
void refuse(Tcm2CalibrationBench& bench, const std::string& refused) {
  bench.command_passes = [&bench, refused](const std::string& command) {
    if (command != refused + '\r') return true;
    bench.reply_later(":E010\r\n");
    return false;
  };
}

TEST(Tcm2CalibrationTrouble, ARefusalEndsIt) {
  const std::map<std::string, std::string> expected{
      {"cc", "h h cc go "},
      {"mpcal=e", "h h cc mpcal=e go "},
      {"mpcal=d", "h h cc mpcal=e go h h mpcal=d go "},
  };
  for (const auto& [command, transcript] : expected) {
    Tcm2CalibrationBench bench(36);
    refuse(bench, command);
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(60 * base::kSecond_ns);
    EXPECT_EQ(bench.transcript(), transcript);
    EXPECT_EQ(bench.dialogue.state(), "failed: " + command + " refused (E010)");
    EXPECT_FALSE(bench.horizontal());
    EXPECT_TRUE(bench.words_flow()) << command;
  }
}

TEST(Tcm2CalibrationTrouble, LateAnswersAreNotTakenForOthers) {
  Tcm2CalibrationBench bench(36);
  bench.delay_ns = 650 * base::kMillisecond_ns;  // after the command was repeated
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(120 * base::kSecond_ns);
  ASSERT_TRUE(bench.horizontal()) << bench.dialogue.state() << ": " << bench.transcript();
  EXPECT_EQ(bench.horizontal(), 9) << "not the score that cc answers";
  EXPECT_TRUE(bench.words_flow());
}

TEST(Tcm2CalibrationTrouble, ALossOfPowerAtAnyTime) {
  for (std::int64_t at_ms = 50; at_ms < 24'000; at_ms += at_ms < 2000 ? 50 : 480) {
    Tcm2CalibrationBench bench(36);
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(at_ms * base::kMillisecond_ns);
    if (!bench.dialogue.busy()) continue;
    bench.power_cycle();
    bench.run_for(60 * base::kSecond_ns);
    EXPECT_FALSE(bench.dialogue.busy()) << at_ms;
    EXPECT_TRUE(bench.words_flow()) << at_ms << " ms: " << bench.dialogue.state();
    if (at_ms < 20'000) {
      EXPECT_EQ(bench.dialogue.state(), "failed: the compass has restarted") << at_ms;
    }
  }
}

TEST(Tcm2CalibrationTrouble, WordsThatStopWithoutABanner) {
  Tcm2CalibrationBench bench(36);
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(5 * base::kSecond_ns);
  bench.line_passes = [](const std::string&) { return false; };
  bench.run_for(60 * base::kSecond_ns);
  EXPECT_EQ(bench.dialogue.state(), "failed: its words have stopped");
  EXPECT_EQ(bench.transcript(), "h h cc mpcal=e go h h mpcal=d mpcal=d mpcal=d go go go ");
}

TEST(Tcm2CalibrationTrouble, ADeviceThatIsUnpluggedEndsItAtAnyTimeAndItCanBeginAnew) {
  for (const std::int64_t at_ms : {0, 50, 300, 450, 900, 5'000, 19'000, 20'500, 20'900}) {
    Tcm2CalibrationBench bench(36);
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(at_ms * base::kMillisecond_ns);
    if (!bench.dialogue.busy()) continue;
    const bool had_score = bench.horizontal().has_value();
    const auto commands = bench.sent.size();
    bench.dialogue.abandon("the compass went away");
    EXPECT_FALSE(bench.dialogue.busy()) << at_ms;
    EXPECT_EQ(bench.dialogue.state() == "failed: the compass went away", !had_score) << at_ms;
    bench.run_for(10 * base::kSecond_ns);
    EXPECT_EQ(bench.sent.size(), commands) << "nobody is there to be told, " << at_ms;

    bench.power_cycle();
    bench.run_for(2 * base::kSecond_ns);  // its banner
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(60 * base::kSecond_ns);
    ASSERT_TRUE(bench.horizontal()) << at_ms << ": " << bench.dialogue.state();
    EXPECT_TRUE(bench.words_flow()) << at_ms;
  }
}

TEST(Tcm2CalibrationTrouble, UnpluggedWhenNothingIsUnderWayItStaysAsItWas) {
  Tcm2CalibrationBench bench(36);
  bench.dialogue.abandon("the compass went away");
  EXPECT_EQ(bench.dialogue.state(), "not begun");
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(60 * base::kSecond_ns);
  const std::string state = bench.dialogue.state();
  bench.dialogue.abandon("the compass went away");
  EXPECT_EQ(bench.dialogue.state(), state);
}

}  // namespace
}  // namespace navcal::instruments::test
