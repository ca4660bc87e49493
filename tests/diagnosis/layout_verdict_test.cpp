// SPDX-License-Identifier: Apache-2.0
// Verdicts on searches that are made up: two causes of one column each, and three nominal recordings.
#include "diagnosis/layout_verdict.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

/// A search that found the first cause at strength 1, clearly, in a recording that it describes.
struct Searched {
  CauseLibrary library;
  NominalBank bank;
  CauseSearchResult found;
  RecordingPower after;
  std::vector<ExplainedRecording> held_out;
  gap::Closure pooled;
  double before = 1;

  Searched() {
    for (Eigen::Index i = 0; i < 2; ++i) {
      library.causes.push_back({.name = i == 0 ? "first" : "second",
                                .of = "thruster.1",
                                .manoeuvre = {},
                                .parameters = {{.name = "k", .low = -10, .high = 10, .column = i}}});
    }
    after.of_channel.fill(1);
    for (const double one : {0.98, 1.0, 1.02}) {
      bank.powers.push_back(after);
      bank.powers.back().mean_square = one;
      bank.powers.back().of_channel.fill(one);
    }
    bank.chance_nats = {0, 0};
    bank.leads = {kGap_nats, kNamed_nats, kClass_nats, kFaint_nats, {}, false};
    found.sets = {{{0}, 40, 0.99}, {{1}, 10, 0.008}, {{}, 0, 0.002}};
    found.changes = {1e4 * Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(1e4, 0), 0};
  }

  [[nodiscard]] gap::Diagnosis verdict() const {
    gap::Diagnosis answer;
    answer.gap.pooled = pooled;
    write_verdict({library, bank, found, after, held_out,
                   [](const CauseSet& set) {
                     return gap::Closure{2, 1, 1, set[0] == 0 ? 0.98 : 0.95, {}};
                   },
                   before},
                  answer);
    return answer;
  }
};

void expect_unknown(const Searched& searched, std::string_view because) {
  const gap::Diagnosis answer = searched.verdict();
  EXPECT_EQ(answer.verdict, gap::Verdict::unknown);
  EXPECT_TRUE(answer.effects.empty());
  EXPECT_NE(answer.sentence.find(because), std::string::npos) << answer.sentence;
}

TEST(LayoutVerdict, NamesACauseThatIsClearAndDescribesTheRecording) {
  const gap::Diagnosis answer = Searched().verdict();
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "first");
  EXPECT_NEAR(answer.effects[0].parameters.at(0).value, 1, 0.01);
  EXPECT_TRUE(answer.effects[0].confused_with.empty());
}

/// A third cause beside the first one.
Searched with_a_third() {
  Searched searched;
  searched.library.causes.push_back({.name = "third",
                                     .of = "hull",
                                     .manoeuvre = {},
                                     .parameters = {{.name = "k", .low = -10, .high = 10, .column = 2}}});
  searched.bank.chance_nats = {0, 0, 0};
  searched.found.changes = {1e4 * Eigen::MatrixXd::Identity(3, 3), Eigen::Vector3d(1e4, 0, 1e4), 0};
  return searched;
}

// A weight with two innocent causes beside it was not named, because a buoyancy in its place had been scored
// alone.
TEST(LayoutVerdict, WhatCouldStandInItsPlaceIsFoundInAnyGoodSet) {
  Searched searched = with_a_third();
  searched.found.sets = {{{0, 2}, 40, 0.9}, {{0}, 37, 0.06}, {{1}, 34, 0.02}, {{}, 0, 0}};
  const gap::Diagnosis answer = searched.verdict();
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "first");
  ASSERT_EQ(answer.effects[0].confused_with.size(), 1U);
  EXPECT_EQ(answer.effects[0].confused_with[0].name, "second of thruster.1");
}

TEST(LayoutVerdict, BesideACauseOfThousandsOfNatsTensNameNothing) {
  Searched searched = with_a_third();
  searched.after.readings_of_channel[0] = 5000;
  searched.found.sets = {{{0, 2}, 40, 0.9}, {{0}, 20, 0.06}, {{}, 0, 0}};
  EXPECT_EQ(searched.verdict().effects.size(), 2U);
  searched.found.sets = {{{0, 2}, 2040, 0.9}, {{0}, 2020, 0.06}, {{}, 0, 0}};
  const gap::Diagnosis answer = searched.verdict();
  ASSERT_EQ(answer.effects.size(), 1U) << answer.sentence;
  EXPECT_EQ(answer.effects[0].name, "first");
  EXPECT_NE(answer.remarks.front().find("third of hull, leads by 20 nats only; a name takes 41"),
            std::string::npos)
      << answer.remarks.front();
  // Nats beyond the number of readings tell nothing more.
  searched.found.sets = {{{0, 2}, 2e6, 0.9}, {{0}, 2e6 - 110, 0.06}, {{}, 0, 0}};
  EXPECT_EQ(searched.verdict().effects.size(), 2U);
}

TEST(LayoutVerdict, OneNominalRecordingTellsNothingOfTheScatterBetweenRecordings) {
  Searched searched;
  searched.found.sets = {{{0}, 15, 0.99}, {{1}, 2, 0.01}, {{}, 0, 0.002}};
  EXPECT_NE(searched.verdict().verdict, gap::Verdict::no_gap);
  searched.bank.powers.resize(1);
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::no_gap);
}

// The one fix of each nominal dive was right to a fiftieth of its noise, and then every dive had a louder fix.
TEST(LayoutVerdict, TheOnlyReadingOfAChannelSetsNoFloor) {
  RecordingPower nominal;
  nominal.of_channel.fill(1);
  nominal.readings_of_channel.fill(1000);
  const auto rate = static_cast<std::size_t>(identify::Channel::rate_x);
  const auto fix = static_cast<std::size_t>(identify::Channel::east_velocity);
  nominal.of_channel[fix] = 3e-4;
  nominal.readings_of_channel[fix] = 1;
  RecordingPower other = nominal;
  other.of_channel[fix] = 4;
  const std::vector<RecordingPower> three(3, nominal);
  EXPECT_TRUE(louder_channels(other, three).empty());
  other.of_channel[rate] = 3;
  const auto louder = louder_channels(other, three);
  ASSERT_EQ(louder.size(), 1U);
  EXPECT_EQ(louder[0].channel, "roll rate");
}

TEST(LayoutVerdict, NoGapSaysWhatWouldHaveStoodOut) {
  Searched searched;
  searched.found.sets = {{{}, 0, 0.99}, {{0}, -6, 0.01}};
  searched.found.changes.information = Eigen::Vector2d(1e4, 1e-4).asDiagonal();
  searched.found.changes.score.setZero();
  const gap::Diagnosis answer = searched.verdict();
  ASSERT_EQ(answer.least_visible.size(), 2U);
  const gap::LeastVisible& first = answer.least_visible[0];
  EXPECT_EQ(first.words(), "first of thruster.1");
  ASSERT_TRUE(first.value);
  // Half the square of value over error pays for the threshold and the penalties of a cause.
  const double nats = *first.value * *first.value * 1e4 / 2;
  EXPECT_GT(nats, kGap_nats);
  EXPECT_LT(nats, 3 * kGap_nats);
  EXPECT_EQ(answer.least_visible[1].name, "second");
  EXPECT_FALSE(answer.least_visible[1].value);
  EXPECT_NE(answer.remarks.back().find("first of thruster.1 from k 0.0"), std::string::npos)
      << answer.remarks.back();
  EXPECT_NE(answer.remarks.back().find("Of 1 of 2 effects no size"), std::string::npos) << answer.remarks.back();
  // Where nominal recordings have more for it by chance, it takes more to stand out.
  searched.bank.chance_nats[0] = 30;
  EXPECT_GT(*searched.verdict().least_visible[0].value, 1.5 * *first.value);
}

TEST(LayoutVerdict, WithoutACauseAndALouderChannelThereIsNoGap) {
  Searched searched;
  searched.found.sets = {{{}, 0, 0.99}, {{0}, -6, 0.01}};
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::no_gap);
  EXPECT_EQ(searched.verdict().sentence, "Nothing exceeds what nominal recordings show.");
  searched.found.sets = {{{0}, 7, 0.99}, {{}, 0, 0.01}};
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::no_gap);
  EXPECT_NE(searched.verdict().sentence.find("a faint lead of first of thruster.1"), std::string::npos);
  searched.found.sets = {{{}, 0, 0.99}, {{0}, -6, 0.01}};
  searched.after.of_channel[0] = 3;
  expect_unknown(searched, "Outside the library: there is a gap");
  EXPECT_EQ(searched.verdict().kind, gap::UnknownKind::outside);
}

TEST(LayoutVerdict, ALeadThatIsTooSmallAndWouldCloseTheGapIsNotOutsideTheLibrary) {
  Searched searched;
  searched.found.sets = {{{}, 0, 0.9}, {{0}, -2.2, 0.1}};
  searched.after.mean_square = 3;
  expect_unknown(searched, "first of thruster.1 would explain it, but stands out too little");
  EXPECT_EQ(searched.verdict().kind, gap::UnknownKind::cannot_say);
}

TEST(LayoutVerdict, CausesThatCannotBeToldApartAreOneAnswer) {
  Searched searched;
  searched.found.sets[1].log_odds = 38;
  const gap::Diagnosis answer = searched.verdict();
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.at(0).confused_with.size(), 1U);
  EXPECT_EQ(answer.effects[0].confused_with[0].name, "second of thruster.1");
  EXPECT_EQ(answer.effects[0].confused_with[0].separation_nats, 2);
  EXPECT_NE(answer.sentence.find("first of thruster.1 or second of thruster.1"), std::string::npos);
}

TEST(LayoutVerdict, ACauseWithProbableRivalsIsNotNamed) {
  Searched searched;
  searched.found.sets[1].log_odds = 30;
  searched.found.sets[1].probability = 0.02;
  expect_unknown(searched, "first of thruster.1 (probability 0.99, 98 % closed), or second of thruster.1");
  const gap::Diagnosis answer = searched.verdict();
  EXPECT_EQ(answer.kind, gap::UnknownKind::ambiguous);
  ASSERT_EQ(answer.alternatives.size(), 2U);
  EXPECT_EQ(answer.alternatives[1].closed, 0.95);
  EXPECT_NE(answer.unexplained.at(0).find("leads by 10 nats only"), std::string::npos);
  searched.after.mean_square = 1.4;
  EXPECT_EQ(searched.verdict().kind, gap::UnknownKind::outside) << "none of them describes the recording";
}

// "Ambiguous: ... (probability 1.00), or ... (probability 0.00)" was said of a lead that was too small for a name.
TEST(LayoutVerdict, ALeadThatIsTooSmallForANameIsNotAmbiguousWithWhatIsImprobable) {
  Searched searched;
  searched.found.sets[1].log_odds = 30;
  searched.found.sets[1].probability = 0.0001;
  expect_unknown(searched,
                 "There is a gap, but its cause cannot be said: the most probable cause, first of thruster.1, "
                 "leads by 10 nats "
                 "only; a name takes 15");
  EXPECT_EQ(searched.verdict().kind, gap::UnknownKind::cannot_say);
}

// Which set is the best is open; that the first cause belongs to it is not.
TEST(LayoutVerdict, WhatAllGoodSetsShareIsNamed) {
  Searched searched;
  searched.found.sets = {{{0, 1}, 41, 0.7}, {{0}, 40, 0.29}, {{1}, 10, 0.005}, {{}, 0, 0.005}};
  const gap::Diagnosis answer = searched.verdict();
  ASSERT_EQ(answer.verdict, gap::Verdict::explained) << answer.sentence;
  ASSERT_EQ(answer.effects.size(), 1U);
  EXPECT_EQ(answer.effects[0].name, "first");
}

// A dead thruster was ambiguous, because a weak one with a dead band beside it was 7 nats behind.
TEST(LayoutVerdict, AWeakActuatorInPlaceOfADeadOneIsNoRival) {
  Searched searched;
  searched.library.causes[0].name = "actuator_dead";
  searched.library.causes[1].name = "thrust_scale";
  searched.library.causes.push_back({.name = "third",
                                     .of = {},
                                     .manoeuvre = {},
                                     .parameters = {{.name = "k", .low = -10, .high = 10, .column = 1}}});
  searched.bank.chance_nats = {0, 0, 0};
  searched.found.sets = {{{0}, 40, 0.99}, {{1, 2}, 33, 0.01}, {{}, 0, 0}};
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained) << searched.verdict().sentence;
  searched.library.causes[1].name = "thruster_offset";
  EXPECT_EQ(searched.verdict().kind, gap::UnknownKind::ambiguous) << searched.verdict().sentence;
}

TEST(LayoutVerdict, ACauseThatNominalRecordingsHaveByChanceIsNotNamed) {
  Searched searched;
  searched.bank.chance_nats[0] = 30;
  expect_unknown(searched, "nats only; a name takes 45");
}

TEST(LayoutVerdict, WithoutNominalRecordingsNothingIsNamed) {
  Searched searched;
  searched.bank = {};
  searched.bank.chance_nats = {0, 0};
  searched.bank.leads = {kGap_nats, kNamed_nats, kClass_nats, kFaint_nats, {}, false};
  expect_unknown(searched,
                 "without nominal recordings (--nominal): the most probable candidate is first of "
                 "thruster.1, k 1 +- 0.01");
  EXPECT_EQ(searched.verdict().candidates.size(), 2U);
  searched.found.sets = {{{}, 0, 0.9}, {{0}, -2.2, 0.1}};
  expect_unknown(searched, "a gap cannot be ruled out");
}

TEST(LayoutVerdict, ACauseThatLeavesAChannelLouderIsNotNamed) {
  Searched searched;
  searched.after.of_channel[2] = 2.5;
  expect_unknown(searched, "louder than nominal");
}

TEST(LayoutVerdict, ACauseThatDoesNotDescribeTheRecordingIsNotNamed) {
  Searched searched;
  searched.after.mean_square = 1.4;
  expect_unknown(searched, "the recording departs by 1.40 times its noise power, nominal ones by 1.00 times");
}

// A reversed thruster closed 97 % of its gap, and was not named for the rest.
TEST(LayoutVerdict, ACauseThatClosesALargeGapIsNamedThoughASmallPartOfItIsLeft) {
  Searched searched;
  searched.after.mean_square = 1.4;
  searched.after.of_channel[2] = 2.5;
  searched.pooled.closed_ci = {0.85, 0.97};
  expect_unknown(searched, "louder than nominal");
  searched.pooled.closed_ci = {0.95, 0.97};
  const gap::Diagnosis answer = searched.verdict();
  EXPECT_EQ(answer.verdict, gap::Verdict::explained);
  EXPECT_TRUE(std::ranges::any_of(answer.remarks, [](const std::string& remark) {
    return remark.find("a small part of the gap is left") != std::string::npos;
  }));
}

TEST(LayoutVerdict, ACauseThatCannotBeToldFromZeroIsNotNamed) {
  Searched searched;
  searched.found.changes.information *= 1e-4;
  searched.found.changes.score *= 1e-4;
  expect_unknown(searched, "the strength of first of thruster.1 cannot be told from zero");
}

TEST(LayoutVerdict, ACauseThatMakesAHeldOutRecordingWorseIsNotNamed) {
  Searched searched;
  searched.before = searched.pooled.before = 1.5;
  searched.held_out.push_back({-3, {-3}, {}, {}});
  expect_unknown(searched, "does not improve the held-out recordings");
  searched.held_out.push_back({50, {50}, {}, {}});
  expect_unknown(searched, "-3.0 in the worst one");
  searched.held_out.erase(searched.held_out.begin());
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
}

// A damping of heave that one nominal recording of three wanted by 34 nats, where the others lost 65 with it.
TEST(LayoutVerdict, ALeadThatHeldOutRecordingsRefuteIsNoGapWhereAllTogetherAreAsNominalOnes) {
  Searched searched;
  searched.held_out = {{-30, {-30}, {}, {}}, {-35, {-35}, {}, {}}};
  searched.pooled.before = 1.01;
  const gap::Diagnosis answer = searched.verdict();
  EXPECT_EQ(answer.verdict, gap::Verdict::no_gap);
  EXPECT_NE(answer.sentence.find("but for first of thruster.1, which the held-out recordings refute"),
            std::string::npos)
      << answer.sentence;
  EXPECT_FALSE(answer.least_visible.empty());
  searched.pooled.before = 1.2;
  expect_unknown(searched, "does not improve the held-out recordings");
  searched.pooled.before = 1.01;
  searched.held_out = {{30, {30}, {}, {}}, {35, {35}, {}, {}}};
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
}

// A damping of pitch took up the drag of a tether: it made held-out recordings more probable, and no quieter.
TEST(LayoutVerdict, ACauseWithWhichHeldOutRecordingsDoNotDepartLessIsNotNamed) {
  Searched searched;
  searched.held_out.push_back({50, {50}, {}, {}});
  searched.pooled.closed = -0.02;
  expect_unknown(searched, "with first of thruster.1 the held-out recordings do not depart less");
  searched.pooled.closed = 0.01;
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
}

TEST(LayoutVerdict, AnImplausibleStrengthIsNotNamed) {
  Searched searched;
  searched.library.causes[0].parameters[0].high = 1000;
  searched.found.changes.score *= 2.2 * kLargestStrength;
  expect_unknown(searched, "times its typical strength");
}

TEST(LayoutVerdict, AnActuatorMayLoseAnyPart) {
  Searched searched;
  CauseParameter& parameter = searched.library.causes[0].parameters[0];
  parameter = {.name = "scale", .typical = 0.08, .low = -1, .high = 1};
  searched.found.changes.score *= -0.5;
  EXPECT_EQ(searched.verdict().verdict, gap::Verdict::explained);
  searched.found.changes.score *= -1;
  expect_unknown(searched, "times its typical strength");
  searched.found.changes.score *= -1;
  searched.library.causes[0].of = "sway";
  expect_unknown(searched, "times its typical strength");
}

TEST(Floor, HasRoomForTheScatterAndForTolerancesThatNominalRecordingsDoNotShow) {
  EXPECT_EQ(floor_of({}).mean, 1);
  const std::array one{4.0};
  EXPECT_DOUBLE_EQ(floor_of(one).limit(1.5), 6.25) << "five deviations of 0.1 of the root, 2";
  const std::array wide{1.0, 3.0};
  EXPECT_GT(floor_of(wide).limit(1.5), 2 + 5);
  const std::array two{1.0, 1.2};
  const std::array six{1.0, 1.2, 1.0, 1.2, 1.0, 1.2};
  EXPECT_GT(floor_of(two).limit(1), 3) << "two tell little of the scatter";
  EXPECT_LT(floor_of(six).limit(1), 1.5);
}

}  // namespace
}  // namespace navcal::diagnosis
