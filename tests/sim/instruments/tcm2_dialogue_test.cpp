// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "protocols/tcm2.h"
#include "sim/instruments/tcm2.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

struct Tcm2Dialogue : ::testing::Test {
  Still motion;
  Tcm2 compass{{}, motion};
  std::int64_t t_ns = kStart_ns;

  void SetUp() override {
    compass.power_on(t_ns);
    t_ns += kSecond_ns;
    const std::string banner = text_of(run_to(compass, t_ns));
    ASSERT_EQ(banner.rfind("TCM2", 0), 0U) << banner;
  }
  std::string command(std::string_view line, double seconds = 0.02) { return say(compass, t_ns, line, seconds); }
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

TEST_F(Tcm2Dialogue, IsSilentUntilToldToGoAndHaltsWhenTold) {
  EXPECT_EQ(text_of(run_to(compass, t_ns += 10 * kSecond_ns)), "");
  EXPECT_EQ(lines(command("go\r", 1.001)), 11);  // the colon and ten words
  EXPECT_EQ(lines(command("h\r", 3)), 1);
}

TEST_F(Tcm2Dialogue, TheStartUpOfTheInterfaceDocument) {
  EXPECT_EQ(command("h\r", 0.1), ":\r\n");
  EXPECT_EQ(command("h\r", 0.1), ":\r\n");
  for (const char* setting :
       {"ec=e\r", "ep=e\r", "er=e\r", "em=e\r", "et=e\r", "uc=d\r", "ui=d\r", "ut=c\r", "sdo=t\r"}) {
    EXPECT_EQ(command(setting), ":\r\n") << setting;
  }
  const std::string words = command("go\r", 0.25);
  protocols::tcm2::Parser parser;
  int full = 0;
  parser.feed(bytes_of(words), [&](const protocols::Frame& frame) {
    if (frame.id != protocols::tcm2::kWord) return;
    const auto word = protocols::tcm2::decode_word(frame.bytes);
    full += word && word->heading && word->pitch && word->roll && word->field() && word->temperature ? 1 : 0;
  });
  EXPECT_EQ(full, 2);
  EXPECT_EQ(parser.counters().skipped_bytes, 0U) << words;
}

TEST_F(Tcm2Dialogue, RefusalsNameTheirKind) {
  EXPECT_EQ(command("GO\r"), ":E010\r\n") << "case counts";
  EXPECT_EQ(command("clock=99\r"), ":E040\r\n");
  EXPECT_EQ(command("sdo=r\r"), ":E040\r\n");
}

TEST_F(Tcm2Dialogue, CommandsInPiecesAndWithLineFeeds) {
  EXPECT_EQ(command("e"), "");
  EXPECT_EQ(command("c=d"), "");
  EXPECT_EQ(command("\r\n"), ":\r\n");
  EXPECT_EQ(lines(command("ec=e\r\nep=d\rer=d\r\n")), 3);
}

TEST_F(Tcm2Dialogue, OneQuantityAtATime) {
  const auto fields = [&](std::string_view line) {
    const std::string text = command(line, 0.2);
    std::string letters;
    for (const char c : text) {
      if (protocols::tcm2::kFieldLetters.find(c) != std::string_view::npos) letters += c;
      if (c == '*') break;
    }
    return letters;
  };
  EXPECT_EQ(fields("s?\r"), "CPRT");
  EXPECT_EQ(fields("c?\r"), "C");
  EXPECT_EQ(fields("i?\r"), "PR");
  EXPECT_EQ(fields("m?\r"), "XYZ");
  EXPECT_EQ(fields("t?\r"), "T");
}

TEST_F(Tcm2Dialogue, RateByClockAndDivider) {
  command("clock=20\r");
  command("sp=5\r");
  EXPECT_EQ(lines(command("go\r", 2.001)), 9);  // 4 Hz
}

TEST_F(Tcm2Dialogue, NmeaHeadings) {
  command("sdo=n\r");
  EXPECT_EQ(command("s?\r", 0.2).rfind("$HCHDM,", 0), 0U);
}

TEST_F(Tcm2Dialogue, ASpeedIsInForceAfterARestartOnlyAndSettingsOutliveIt) {
  command("em=e\r");
  command("b=5\r");
  EXPECT_EQ(compass.baud(), 38400);
  EXPECT_EQ(command("ax\r", 1).rfind("TCM2", 0), 0U);
  EXPECT_EQ(compass.baud(), 9600);
  EXPECT_NE(command("s?\r", 0.2).find('X'), std::string::npos);
  compass.power_on(t_ns);
  EXPECT_EQ(command("", 1).rfind("TCM2", 0), 0U);
  EXPECT_EQ(command("s?\r", 0.2).find('X'), std::string::npos) << "a loss of power forgets them";
}

TEST_F(Tcm2Dialogue, ASlowLineLeavesWordsOutAndNeverMixesThem) {
  command("b=0\r");
  command("ax\r", 2);  // 300 baud: a word takes a second
  const std::string text = command("go\r", 10);
  protocols::tcm2::Parser parser;
  parser.feed(bytes_of(text), [](const protocols::Frame&) {});
  EXPECT_EQ(parser.counters().skipped_bytes, 0U) << text;
  EXPECT_GT(lines(text), 5);
  EXPECT_LT(lines(text), 20);
}

TEST_F(Tcm2Dialogue, BuiltInCalibrationScoresTheTurnsMade) {
  EXPECT_EQ(command("cc\r"), "H0V0M0.00\r\n");
  command("mpcal=e\r");
  command("go\r", 0);
  for (int degrees = 0; degrees < 720; degrees += 5) {
    motion.state.euler_rad = {0.35 * (degrees % 90 < 45 ? 1 : -1), 0.3 * (degrees % 60 < 30 ? 1 : -1),
                              degrees / 57.3};
    run_to(compass, t_ns += kSecond_ns);
  }
  command("h\r", 1);
  const std::string score = command("mpcal=d\r");
  EXPECT_EQ(score.rfind("H9V9M", 0), 0U) << score;
  EXPECT_EQ(command("lc?\r"), score);
}

}  // namespace
}  // namespace navcal::sim::testing
