// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace navcal::gap {
namespace {

/// A single that wins clearly, leaves nothing, and improves what was held out.
class Case {
 public:
  explicit Case(double strength, double expected_information_nats = 1000) {
    found_.best.effects = {7};
    found_.best.mean = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library_.unknowns().size()));
    const Eigen::Index j = library_.first(7);
    found_.best.mean[j] = strength * library_.unknowns()[static_cast<std::size_t>(j)].typical;
    found_.candidates = {{{7}, 100, 0.99}, {{}, 0, 0.01}};
    found_.expected_information_nats = {expected_information_nats};
  }

  void add_unnamed(double strength) {
    const Eigen::Index j = library_.first(3);
    found_.best.mean[j] = strength * library_.unknowns()[static_cast<std::size_t>(j)].typical;
  }
  /// Besides the effect and none, others share what is left.
  void set_probabilities(double effect, double none) {
    found_.candidates = {{{7}, 2, effect}, {{3}, 1, 1 - effect - none}, {{}, 0, none}};
  }
  void set_candidates(std::vector<Candidate> candidates) { found_.candidates = std::move(candidates); }
  void set_where(double p_value) {
    WhereEntry entry;
    entry.p_value = p_value;
    where_ = {entry};
  }
  /// Why the effect does not explain the gap, in one text, where it closes `closed` of it.
  [[nodiscard]] std::string reasons(double closed, std::vector<double> held_out_nats) const {
    const PooledClosure closure{2, 1.5, 1, true, closed, closed - 0.1 * std::abs(closed), closed};
    std::string text;
    for (const auto& reason :
         judge({found_, library_, where_, nothing_, std::move(held_out_nats), closure, closure, false}).reasons) {
      text += reason + "\n";
    }
    return text;
  }
  [[nodiscard]] UnknownKind kind(double closed, std::vector<double> held_out_nats, bool blocks) const {
    const PooledClosure closure{2, 1.5, 1, true, closed, closed - 0.1, closed};
    return judge({found_, library_, where_, nothing_, std::move(held_out_nats), closure, closure, blocks}).kind;
  }
  [[nodiscard]] Verdict verdict(double closed_upper, double closed_by_all_upper) const {
    const PooledClosure alone{2, 1.5, 1, true, closed_upper - 0.1, closed_upper - 0.2, closed_upper};
    const PooledClosure by_all{
        2, 1, 1, true, closed_by_all_upper - 0.1, closed_by_all_upper - 0.2, closed_by_all_upper};
    return judge({found_, library_, where_, nothing_, {20, 20}, alone, by_all, false}).verdict;
  }

 private:
  Library library_{{}};
  SearchResult found_;
  std::vector<WhereEntry> where_, nothing_;
};

TEST(Verdict, AnEffectThatClosesTheGapExplainsIt) {
  EXPECT_EQ(Case(1).verdict(0.99, 0.99), Verdict::explained);
  EXPECT_EQ(Case(0.1).verdict(0.99, 0.99), Verdict::explained);
}

TEST(Verdict, WhatIsLeftMayBeTolerancesIfThoseFoundForetellIt) {
  EXPECT_EQ(Case(1).verdict(0.3, 0.99), Verdict::explained);
  EXPECT_EQ(Case(1).verdict(0.3, 0.6), Verdict::unknown) << "something outside the library is at work";
}

TEST(Verdict, WhatSpeaksAgainstTheLibraryIsToldFromALackOfEvidence) {
  EXPECT_EQ(Case(1).kind(0.3, {20, 20}, false), UnknownKind::outside) << "it does not close the gap";
  EXPECT_EQ(Case(9).kind(0.99, {20, 20}, false), UnknownKind::outside) << "no cause is as strong";
  EXPECT_EQ(Case(1).kind(0.99, {20, -20}, false), UnknownKind::outside) << "a held-out mission is worse";
  EXPECT_EQ(Case(1).kind(0.99, {20, -20}, true), UnknownKind::cannot_say) << "minutes differ";
  EXPECT_EQ(Case(1, 0.5).kind(0.99, {20, 20}, false), UnknownKind::cannot_say) << "it hardly shows";
  Case rivals(1);
  rivals.set_probabilities(0.6, 0);
  EXPECT_EQ(rivals.kind(0.99, {20, 20}, false), UnknownKind::cannot_say);
}

// On a steady turn gyro_cross_axis was named that closed 1 % of the gap; fin_gain of 43 % of its usual strength,
// taken for a tolerance, closed the rest.
TEST(Verdict, WhatClosesTheGapUnnamedMustBeATolerance) {
  Case ordinary(1), strong(1);
  ordinary.add_unnamed(0.1);
  strong.add_unnamed(0.5);
  EXPECT_EQ(ordinary.verdict(0.3, 0.99), Verdict::explained);
  EXPECT_EQ(strong.verdict(0.3, 0.99), Verdict::unknown);
  EXPECT_EQ(strong.verdict(0.99, 0.99), Verdict::explained) << "the named effect closes it alone";
}

TEST(Verdict, ATolerancedEffectIsNoCauseOfAGapThatItDoesNotClose) {
  EXPECT_EQ(Case(0.05).verdict(0.3, 0.99), Verdict::unknown);
  EXPECT_EQ(Case(0.15).verdict(0.3, 0.99), Verdict::unknown);
}

// Backlash of a hundredth of the usual was named with certainty: every vehicle has that, and the data were clear.
TEST(Verdict, AToleranceIsNoCauseHoweverClearItIs) { EXPECT_EQ(Case(0.03).verdict(0.99, 0.99), Verdict::unknown); }

// On a straight course an effect of many parameters was named that such a mission does not show at all.
TEST(Verdict, WhatAMissionDoesNotShowIsNotNamedByIt) {
  EXPECT_EQ(Case(4, 0.5).verdict(0.99, 0.99), Verdict::unknown);
  EXPECT_EQ(Case(4, 11).verdict(0.99, 0.99), Verdict::explained);
}

// A nominal vehicle was said to have a gap since none of 34 effects was quite as improbable as none at all.
TEST(Verdict, WhereNothingIsClearAndNothingIsProbableThereIsNoGap) {
  Case weak(0.3);
  weak.set_probabilities(0.3, 0.05);
  EXPECT_EQ(weak.verdict(0.99, 0.99), Verdict::no_gap);
  weak.set_probabilities(0.3, 0.001);
  EXPECT_EQ(weak.verdict(0.99, 0.99), Verdict::unknown) << "something is there, but what?";
  weak.set_probabilities(0.3, 0.05);
  weak.set_where(1e-6);
  EXPECT_EQ(weak.verdict(0.99, 0.99), Verdict::unknown) << "it is seen where";
}

// On a straight course declination was named for a current, with a probability of 0.79 and 0.21 for its twins.
TEST(Verdict, WhatHasProbableRivalsIsNotNamed) {
  Case rivalled(1), lonely(1);
  rivalled.set_probabilities(0.79, 0.001);
  lonely.set_probabilities(0.79, 0.2);
  EXPECT_EQ(rivalled.verdict(0.99, 0.99), Verdict::unknown);
  EXPECT_EQ(lonely.verdict(0.99, 0.99), Verdict::explained);
}

TEST(Verdict, ASetWithOneEffectMoreIsNoRival) {
  Case single(1);
  single.set_candidates({{{7}, 100, 0.75}, {{3, 7}, 99, 0.24}, {{}, 0, 0.01}});
  EXPECT_EQ(single.verdict(0.99, 0.99), Verdict::explained);
  single.set_candidates({{{7}, 100, 0.75}, {{3, 5}, 99, 0.24}, {{}, 0, 0.01}});
  EXPECT_EQ(single.verdict(0.99, 0.99), Verdict::unknown);
}

TEST(Verdict, WordsForAFitThatGrowsWorseHoldNoAbsurdDigits) {
  const auto says = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  const std::string mixed = Case(1).reasons(-6120.74, {4.6e10, -50});
  EXPECT_TRUE(says(mixed, "makes the fit of 1 of 2 missions held out worse")) << mixed;
  EXPECT_TRUE(says(mixed, "the gap grows instead of going away")) << mixed;
  EXPECT_EQ(mixed.find_first_of("+-"), std::string::npos) << mixed;
  EXPECT_TRUE(says(Case(1).reasons(0.99, {0.5, 0.6}), "makes the fit of missions held out no better"));
  const std::string little = Case(1).reasons(0.3, {20, 20});
  EXPECT_TRUE(says(little, "only 30 % of the gap goes away (95 %: 27 to 30 %)")) << little;
  const std::string huge = Case(5e6).reasons(0.99, {20, 20});
  EXPECT_TRUE(says(huge, "over 100 times as strong as usual")) << huge;
}

TEST(Verdict, OneFarStrongerThanUsualStandsForSomethingElse) {
  EXPECT_EQ(Case(6).verdict(0.99, 0.99), Verdict::unknown);
}

}  // namespace
}  // namespace navcal::gap
