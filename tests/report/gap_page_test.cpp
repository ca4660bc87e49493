// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "report/gap_report.h"
#include "tests/report/gap_samples.h"
#include "tests/report/markup.h"

namespace navcal::cli {
namespace {

using test::count;
using test::flaw_in;
using test::gap_source;

TEST(GapPage, IsWholeWhateverWasFound) {
  for (const auto& diagnosis :
       {gap::Diagnosis{}, test::explained_gap(), test::unknown_gap(), test::no_gap(), test::hostile_gap()}) {
    const std::string page = report::gap_page(diagnosis, gap_source());
    EXPECT_EQ(flaw_in(page), "");
    EXPECT_LT(page.size(), 500'000U);
    for (const char* bad : {"nan", "inf ", "inf<", "inf;", "http", "<script", "url("}) {
      EXPECT_EQ(page.find(bad), std::string::npos) << bad;
    }
  }
}

TEST(GapPage, TheTrackIsDrawnWithTheModelsBeforeAndAfter) {
  const std::string explained = report::gap_page(test::explained_gap(), gap_source());
  for (const char* name : {">fixes</text>", ">nominal model</text>", ">with the effects found</text>"})
    EXPECT_NE(explained.find(name), std::string::npos) << name;
  auto without_cause = test::explained_gap();
  without_cause.verdict = gap::Verdict::unknown;
  without_cause.effects.clear();
  const std::string candidates = report::gap_page(without_cause, gap_source());
  EXPECT_EQ(candidates.find(">with the effects found</text>"), std::string::npos) << "none was found";
  EXPECT_NE(candidates.find(">with the best candidates</text>"), std::string::npos);
  const std::string unknown = report::gap_page(test::unknown_gap(), gap_source());
  EXPECT_NE(unknown.find(">nominal model</text>"), std::string::npos);
  EXPECT_EQ(unknown.find(">with the effects found</text>"), std::string::npos);
  EXPECT_EQ(report::gap_page(gap::Diagnosis{}, gap_source()).find(">nominal model</text>"), std::string::npos);
}

TEST(GapPage, WhatWasNotDoneHasNoFigures) {
  gap::Diagnosis diagnosis;
  diagnosis.verdict = gap::Verdict::unknown;
  const std::string page = report::gap_page(diagnosis, gap_source());
  for (const char* nothing : {", 0.0 s<", "Gyro biases", "no bank of nominal missions"})
    EXPECT_EQ(page.find(nothing), std::string::npos) << nothing;
  EXPECT_NE(report::gap_page(test::explained_gap(), gap_source()).find("Gyro biases"), std::string::npos);
}

TEST(GapPage, AFilesNameIsOnlyAName) {
  const std::string name = "<script>alert(1)</script>&\"'\xff.cap";
  const std::string page = report::gap_page(test::explained_gap(), {{name}, {name}, name, {name}, name});
  EXPECT_EQ(flaw_in(page), "");
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST(GapPage, ShowsWhereWhatAndHowMuch) {
  const std::string page = report::gap_page(test::explained_gap(), gap_source());
  for (const char* said :
       {"Gap between model and a.cap", "class=\"good\">explained", "to do", "What causes it", "motor_field",
        "0.8031\u00a0\u00b1\u00a00.0042\u00a0uT/A", "98 % (95 to 100 %)", "on 2 held-out recordings",
        "may as well be fin_gain", "compass.field against motor current", "The other channels", "adc_droop",
        "dives/a.cap", "c.cap", "navcal simulate --mission survey --effects found.toml",
        "navcal " NAVCAL_VERSION}) {
    EXPECT_NE(page.find(said), std::string::npos) << said;
  }
  EXPECT_EQ(count(page, "<td class=\"heat4 clear\""), 1);
  EXPECT_EQ(count(page, "class=\"whisker\""), 4) << "altogether and three channels";
  EXPECT_EQ(count(page, "fill worse"), 1) << "the channel that grew worse";
}

TEST(GapPage, AnUnknownGapNamesNoCause) {
  auto diagnosis = test::unknown_gap();
  diagnosis.kind = gap::UnknownKind::outside;
  diagnosis.candidates.front().probability = 1;
  const std::string page = report::gap_page(diagnosis, gap_source());
  EXPECT_EQ(page.find("99.9 %"), std::string::npos) << "a share of what explains nothing is no certainty";
  EXPECT_NE(page.find("none of them explains the recording"), std::string::npos);
  EXPECT_NE(page.find("class=\"bad\">unknown"), std::string::npos);
  EXPECT_NE(page.find("No cause is named"), std::string::npos);
  EXPECT_NE(page.find("Remaining residuals"), std::string::npos);
  EXPECT_EQ(page.find("How much of the gap closes"), std::string::npos);
}

TEST(GapPage, WithoutAGapThereIsNoTalkOfCauses) {
  const std::string page = report::gap_page(test::no_gap(), gap_source());
  EXPECT_NE(page.find("class=\"good\">no gap"), std::string::npos);
  EXPECT_NE(page.find("Nowhere"), std::string::npos);
  EXPECT_EQ(page.find("What causes it"), std::string::npos);
  EXPECT_EQ(count(page, " clear\" title"), 0);
}

TEST(GapPage, BarsStayWithinTheirRange) {
  const std::string page = report::gap_page(test::hostile_gap(), gap_source());
  for (auto at = page.find("width:", page.find("<main>")); at != std::string::npos;
       at = page.find("width:", at + 1)) {
    const double width = std::stod(page.substr(at + 6, 20));
    EXPECT_GE(width, 0);
    EXPECT_LE(width, 100);
  }
}

}  // namespace
}  // namespace navcal::cli
