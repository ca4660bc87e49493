// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "report/gap_report.h"
#include "report/gap_words.h"
#include "report/wrapped_text.h"
#include "tests/report/gap_samples.h"

namespace navcal::cli {
namespace {

using test::gap_source;

/// However its lines are broken.
bool says(std::string text, const std::string& part) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::string unbroken;
  for (const std::string& word : report::words_of(text)) unbroken += word + ' ';
  return unbroken.find(part) != std::string::npos;
}

void expect_narrow(const std::string& text) {
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) EXPECT_LE(line.size(), report::kLineWidth) << line;
}

TEST(GapText, WithoutCausesWhatTheInstrumentsShowIsListed) {
  gap::Diagnosis diagnosis;
  diagnosis.sentence = "The causes of a gap cannot be found: a.cap: no inertial card.";
  diagnosis.remarks = {"a.cap: no inertial card", "12 words with E001"};
  calib::CalibratorReport gyro;
  gyro.calibrator = calib::Calibrator::gyro;
  gyro.outcome = calib::Outcome::accepted;
  gyro.estimate = {{"scale", 1.02, 0.001}};
  calib::CalibratorReport misalignment;
  misalignment.calibrator = calib::Calibrator::misalignment;
  misalignment.judgement.reason = "all runs lead one way";
  diagnosis.instruments_alone = calib::Report{};
  diagnosis.instruments_alone->calibrators = {gyro, misalignment};
  const std::string text = report::gap_text(diagnosis, test::gap_source());
  EXPECT_NE(text.find("Gyro A: scale 1.0200 +- 0.0010"), std::string::npos) << text;
  EXPECT_NE(text.find("Misalignment A: not determined, all runs lead one way"), std::string::npos) << text;
  EXPECT_NE(text.find("12 words with E001"), std::string::npos) << text;
  EXPECT_EQ(text.find("how much"), std::string::npos) << text;
  EXPECT_EQ(text.find("no inertial card"), text.rfind("no inertial card")) << text;
}

TEST(GapUnits, AreTakenOutOfEveryParametersName) {
  const auto expect = [](const char* parameter, const char* name, const char* unit) {
    const auto split = report::name_and_unit(parameter);
    EXPECT_EQ(split.name, name) << parameter;
    EXPECT_EQ(split.unit, unit) << parameter;
  };
  expect("x_uT_per_A", "x", "uT/A");
  expect("deg_per_s_per_C_ax", "ax", "deg/s/C");
  expect("deg_per_s2_az", "az", "deg/s2");
  expect("s_per_deg_bz", "bz", "s/deg");
  expect("az_x_deg_per_s_per_g", "az x", "deg/s/g");
  expect("az_from_x", "az from x", "");
  expect("x_m_s2_per_A2", "x", "m/s2/A2");
  expect("per_A", "", "1/A");
  expect("per_s", "", "1/s");
  expect("north_m_s", "north", "m/s");
  expect("tau_s", "tau", "s");
  expect("gain", "gain", "");
  expect("", "", "");
  expect("___", "", "");
}

TEST(GapText, SaysAllThatAPersonNeeds) {
  const std::string text = report::gap_text(test::explained_gap(), gap_source());
  expect_narrow(text);
  EXPECT_EQ(text.find("explained"), 0U);
  for (const char* part :
       {"compass.field", "motor current", "2.13 uT", "< 1e-12", "motor_field", "> 99.9 %",
        "x 0.8031 +- 0.0042 uT/A", "may as well be fin_gain (6.4 nats apart)",
        "told apart by: net turns of two revolutions", "98 % (95 to 100 %)", "14.2 -> 1.23, floor 1.03",
        "on 2 held-out recordings", "nothing to close", "heading error 3.21 -> 0.401 deg", "5.1 -> 0.8 m in 100 m",
        "Two net turns", "navcal simulate --mission survey --effects found.toml",
        "100 simulated missions of the nominal vehicle, seed 1, made in 1 min 24 s", "10 min 12 s"}) {
    EXPECT_TRUE(says(text, part)) << part << '\n' << text;
  }
}

TEST(GapText, AnUnknownGapNamesNoCause) {
  const std::string text = report::gap_text(test::unknown_gap(), {{"a.cap"}, {}, "", {}, ""});
  expect_narrow(text);
  EXPECT_EQ(text.find("unknown"), 0U);
  EXPECT_FALSE(says(text, "causes"));
  EXPECT_FALSE(says(text, "closed "));
  EXPECT_FALSE(says(text, "navcal simulate"));
  for (const char* part :
       {"not convincing", "square of the motor's current", "at 312 s: 0.1 -> 2.3 uT", "to do"}) {
    EXPECT_TRUE(says(text, part)) << part << '\n' << text;
  }
}

TEST(GapText, SaysWhereTheErrorEnters) {
  auto diagnosis = test::unknown_gap();
  const std::string text = report::gap_text(diagnosis, gap_source());
  expect_narrow(text);
  for (const char* part :
       {"the compass's magnetic field (compass.field); next best, 60 nats worse: the compass's heading",
        "x of the compass's magnetic field is off by 0.4 +- 0.02 uT and follows motor current x motor current",
        "on the recordings held out it gains 73 nats: noise power 4.2 -> 1.3, of the nominal vehicle 1.05",
        "It is no cause"}) {
    EXPECT_TRUE(says(text, part)) << part << '\n' << text;
  }
  diagnosis.sources[1].gain_nats = 85;
  EXPECT_TRUE(says(report::gap_text(diagnosis, gap_source()), "they cannot be told apart here (5 nats)"));
  diagnosis.sources.resize(1);
  EXPECT_TRUE(says(report::gap_text(diagnosis, gap_source()), "no other source describes it"));
  diagnosis.sources[0].gain_nats = 4;
  EXPECT_FALSE(says(report::gap_text(diagnosis, gap_source()), "enters at"));
}

TEST(GapText, CandidatesOfAnUnknownGapHaveNoProbability) {
  auto diagnosis = test::unknown_gap();
  diagnosis.kind = gap::UnknownKind::outside;
  diagnosis.candidates.front().probability = 1;
  const std::string text = report::gap_text(diagnosis, gap_source());
  EXPECT_TRUE(says(text, "none of them explains the recording")) << text;
  EXPECT_FALSE(says(text, "99.9 %")) << text;
  EXPECT_TRUE(says(text, "motor_field")) << text;
}

TEST(GapText, AnAmbiguousGapShowsEachSet) {
  auto diagnosis = test::unknown_gap();
  diagnosis.kind = gap::UnknownKind::ambiguous;
  diagnosis.alternatives = {{{diagnosis.candidates[0]}, 0.6, 0.98}, {{diagnosis.candidates[1]}, 0.4, {}}};
  const std::string text = report::gap_text(diagnosis, gap_source());
  EXPECT_TRUE(says(text, "either Each of these sets of effects explains the recording.")) << text;
  EXPECT_TRUE(says(text, "or motor_field, 62.0 %")) << text;
  EXPECT_FALSE(says(text, "not convincing")) << text;
}

TEST(GapWords, AGapThatGrowsIsToldWithoutDigits) {
  gap::Closure closure{1, 7000, 0.9, -6120.74, std::array{-6536.39, -5717.98}};
  EXPECT_EQ(report::closed_text(closure), "grows");
  closure.closed = 0.2;
  closure.closed_ci = std::array{-400.0, 0.7};
  EXPECT_EQ(report::closed_text(closure), "20 % (at most 70 %)");
  closure.closed = -0.09;
  closure.closed_ci.reset();
  EXPECT_EQ(report::closed_text(closure), "-9 %");
}

TEST(GapWords, NoMoreThanTheWholeGapGoesAway) {
  EXPECT_EQ(report::closed_text({1, 0.8, 0.9, 1.83, std::array{1.05, 2.4}}), "100 % (100 to 100 %)");
  EXPECT_EQ(report::closed_text({1, 0.89, 0.9, 1.05, std::array{0.97, 1.1}}), "100 % (97 to 100 %)");
}

TEST(GapText, NoGapIsShort) {
  const std::string text = report::gap_text(test::no_gap(), gap_source());
  EXPECT_EQ(text.find("no gap"), 0U);
  EXPECT_TRUE(says(text, "Nowhere"));
  EXPECT_TRUE(says(text, "from the cache"));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 6);
}

TEST(GapText, NothingAtAllAndTheWorstAreTold) {
  const std::string nothing = report::gap_text({}, {});
  EXPECT_EQ(nothing.find("unknown"), 0U);
  EXPECT_TRUE(says(nothing, "no comparison")) << nothing;
  const std::string text = report::gap_text(test::hostile_gap(), gap_source());
  for (const char* bad : {"nan", "inf"}) EXPECT_FALSE(says(text, bad)) << bad << '\n' << text;
}

TEST(GapText, OnlyTheStrongestPlacesAreListed) {
  auto diagnosis = test::explained_gap();
  while (diagnosis.where.size() < 9) diagnosis.where.push_back(diagnosis.where.back());
  EXPECT_TRUE(says(report::gap_text(diagnosis, gap_source()), "and 4 more"));
}

TEST(GapText, ACommandCanBePasted) {
  auto source = gap_source();
  source.effects_file = "it's here.toml";
  source.vehicle = "my.toml";
  EXPECT_EQ(report::simulate_hint(test::explained_gap(), source),
            "navcal simulate --mission survey --vehicle my.toml --effects 'it'\\''s here.toml' -o with.cap");
  source.effects_file.clear();
  EXPECT_TRUE(says(report::simulate_hint(test::explained_gap(), source), "--effects-out FILE.toml"));
  EXPECT_EQ(report::simulate_hint(test::no_gap(), source), "");
}

TEST(GapText, AnAnswerWithoutHoldOutsIsCalledWeaker) {
  auto diagnosis = test::explained_gap();
  diagnosis.gap.held_out = false;
  EXPECT_TRUE(says(report::gap_text(diagnosis, {{"a.cap"}, {}, "", {}, ""}), "blocks of the same recording"));
}

TEST(GapWords, SharesAndChancesAreRoundedTowardsDoubt) {
  EXPECT_EQ(report::probability_text(1), "> 99.9 %");
  EXPECT_EQ(report::probability_text(0), "< 0.1 %");
  EXPECT_EQ(report::probability_text(0.973), "97.3 %");
  EXPECT_EQ(report::share_text(-0.09), "-9 %");
  EXPECT_EQ(report::share_text(-0.001), "0 %");
  EXPECT_EQ(report::chance_text(3e-9), "1e-8");
  EXPECT_EQ(report::chance_text(1e-9), "1e-9");
  EXPECT_EQ(report::chance_text(0.004), "0.004");
  EXPECT_EQ(report::chance_text(0), "< 1e-12");
  EXPECT_EQ(report::amount(std::numeric_limits<double>::quiet_NaN(), "m"), "-");
}

}  // namespace
}  // namespace navcal::cli
