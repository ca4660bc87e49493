// SPDX-License-Identifier: Apache-2.0
#include "validation/cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>

#include "validation/confounded_effects.h"
#include "validation/missions.h"

namespace navcal::cli {
namespace {

TEST(GapTrialArms, ARoundIsAThirdNullsAndSeventeenRoundsGiveEachTargetItsCases) {
  std::map<validation::TrialArm, int> cases;
  for (int number = 1; number <= 17 * validation::kCasesPerRound; ++number) {
    EXPECT_EQ(validation::ordinal_in_arm(number), cases[validation::arm_of_case(number)]++) << number;
  }
  EXPECT_EQ(cases[validation::TrialArm::nulls], 17 * 11);
  for (const validation::TrialArm arm :
       {validation::TrialArm::single, validation::TrialArm::single_tenth, validation::TrialArm::single_fifth,
        validation::TrialArm::pairs, validation::TrialArm::triples, validation::TrialArm::brief,
        validation::TrialArm::removed, validation::TrialArm::foreign, validation::TrialArm::poor}) {
    EXPECT_EQ(cases[arm], 34) << validation::facts_of(arm).name;
  }
  for (const validation::TrialArm arm :
       {validation::TrialArm::nulls_6, validation::TrialArm::single_half, validation::TrialArm::single_double})
    EXPECT_EQ(cases[arm], 17) << validation::facts_of(arm).name;
}

TEST(GapTrialArms, OfLayoutsAreThoseOfTheirRound) {
  EXPECT_EQ(validation::trial_arms_named({}, validation::layout_round()).size(), 7U);
  EXPECT_EQ(validation::trial_arms_named({"singles"}, validation::layout_round()).size(), 3U);
  EXPECT_THROW((void)validation::trial_arms_named({"triples"}, validation::layout_round()), std::invalid_argument);
  EXPECT_EQ(validation::case_numbers({validation::TrialArm::pairs}, 2, validation::layout_round()),
            (std::vector{10, 26}));
  EXPECT_EQ(validation::ordinal_in_arm(26, validation::layout_round()), 1);
}

TEST(GapTrialArms, FactsStandAtTheirArm) {
  for (const validation::TrialArmFacts& facts : validation::trial_arms())
    EXPECT_EQ(validation::facts_of(facts.arm).name, facts.name);
}

TEST(GapTrialArms, NamesChooseAndUnknownOnesAreRefusedWithTheKnown) {
  EXPECT_EQ(validation::trial_arms_named({}).size(), validation::trial_arms().size());
  EXPECT_EQ(validation::trial_arms_named({"singles"}).size(), 5U);
  EXPECT_EQ(validation::trial_arms_named({"single-0.1", "foreign"}),
            (std::vector{validation::TrialArm::single_tenth, validation::TrialArm::foreign}));
  try {
    (void)validation::trial_arms_named({"doubles"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("no arm doubles; there are nulls, nulls-6"), std::string::npos);
  }
  for (const int number : validation::case_numbers({validation::TrialArm::foreign}, 5))
    EXPECT_EQ(validation::arm_of_case(number), validation::TrialArm::foreign);
}

TEST(GapTrialCases, TheSameSeedAndNumberGiveTheSameCaseAndOthersOthers) {
  for (int number = 1; number <= validation::kCasesPerRound; ++number) {
    EXPECT_EQ(validation::truth_text(validation::drawn_case(7, number, 10), 7),
              validation::truth_text(validation::drawn_case(7, number, 10), 7));
    EXPECT_NE(validation::drawn_case(7, number, 10).mission_seeds,
              validation::drawn_case(8, number, 10).mission_seeds);
    EXPECT_NE(validation::drawn_case(7, number, 10).mission_seeds,
              validation::drawn_case(7, number + 1, 10).mission_seeds);
  }
}

TEST(GapTrialCases, EachHasAPlaceOfTheTrialAndClocksOfItsOwn) {
  std::set<int> places;
  std::set<double> slow;
  for (int number = 1; number <= 2 * validation::kCasesPerRound; ++number) {
    const validation::TrialCase drawn = validation::drawn_case(7, number, 10, 4);
    places.insert(drawn.place_number);
    EXPECT_EQ(drawn.place.begin_ns, validation::drawn_place(7, drawn.place_number).begin_ns);
    for (const double clock :
         {drawn.vehicle.clocks.compass, drawn.vehicle.clocks.card, drawn.vehicle.clocks.motor}) {
      EXPECT_LE(std::abs(clock), 0.01);
      slow.insert(clock);
    }
    // The vehicle is the same, wherever it swims.
    EXPECT_EQ(validation::drawn_case(7, number, 10, 5).mission_seeds, drawn.mission_seeds);
  }
  EXPECT_EQ(places, (std::set<int>{0, 1, 2, 3}));
  EXPECT_EQ(slow.size(), 6U * validation::kCasesPerRound);
}

TEST(GapTrialCases, AnArmComesThroughAllEffectsBeforeOneComesAgain) {
  for (const validation::TrialArm arm : {validation::TrialArm::single, validation::TrialArm::single_tenth,
                                         validation::TrialArm::removed, validation::TrialArm::foreign}) {
    const auto kinds =
        arm == validation::TrialArm::foreign ? reference::foreign_effects() : reference::library_effects();
    std::set<std::string> names;
    for (const int number : validation::case_numbers({arm}, static_cast<int>(kinds.size())))
      names.insert(validation::drawn_case(3, number, 10).effects.at(0).name);
    EXPECT_EQ(names.size(), kinds.size()) << validation::facts_of(arm).name;
  }
}

TEST(GapTrialCases, EachArmHasWhatItIsFor) {
  for (int number = 1; number <= 4 * validation::kCasesPerRound; ++number) {
    const validation::TrialCase drawn = validation::drawn_case(11, number, 10);
    std::set<std::string> names;
    for (const validation::TrialEffect& effect : drawn.effects) names.insert(effect.name);
    const std::size_t wanted =
        drawn.arm == validation::TrialArm::nulls || drawn.arm == validation::TrialArm::nulls_6 ? 0
        : drawn.arm == validation::TrialArm::pairs                                             ? 2
        : drawn.arm == validation::TrialArm::triples                                           ? 3
                                                                                               : 1;
    EXPECT_EQ(names.size(), wanted) << number;
    EXPECT_EQ(drawn.minutes, drawn.arm == validation::TrialArm::brief ? 3 : 10);
    EXPECT_EQ(drawn.excluded, drawn.arm == validation::TrialArm::removed ? *names.begin() : "");
    EXPECT_EQ(drawn.in_library(),
              drawn.arm != validation::TrialArm::removed && drawn.arm != validation::TrialArm::foreign);
  }
}

TEST(GapTrialCases, EverySecondPairIsEasilyConfounded) {
  const auto numbers = validation::case_numbers({validation::TrialArm::pairs}, 6);
  for (std::size_t i = 1; i < numbers.size(); i += 2) {
    const auto effects = validation::drawn_case(5, numbers[i], 10).effects;
    const auto& twins = validation::signature_of(effects.at(0).name)->confounders;
    EXPECT_NE(std::find(twins.begin(), twins.end(), effects.at(1).name), twins.end());
  }
}

TEST(GapTrialCases, TheTruthHoldsTheToleranceToo) {
  for (const int number : validation::case_numbers({validation::TrialArm::single}, 34)) {
    const validation::TrialCase drawn = validation::drawn_case(2, number, 10);
    const validation::TrialEffect& effect = drawn.effects.at(0);
    const reference::EffectKind& kind = *reference::find_effect(effect.name);
    bool moved = false;
    for (const std::string_view key : kind.parameters) {
      const double off = effect.real.find(key)->second - effect.drawn.find(key)->second;
      EXPECT_LT(std::abs(off), 5 * 0.02 * kind.size.typical) << effect.name << ' ' << key;
      moved |= std::abs(off) > 1e-6 * kind.size.typical;
    }
    EXPECT_TRUE(moved) << effect.name;
  }
}

TEST(GapTrialTwins, EveryEffectHasChannelsAndTwinsAreInTheLibrary) {
  for (const auto& kinds : {reference::library_effects(), reference::foreign_effects()}) {
    for (const reference::EffectKind& kind : kinds) {
      const validation::TrialSignature* signature = validation::signature_of(kind.name);
      ASSERT_NE(signature, nullptr) << kind.name;
      EXPECT_FALSE(signature->channels.empty()) << kind.name;
      EXPECT_FALSE(signature->sources.empty()) << kind.name;
      const bool is_foreign = kinds.data() == reference::foreign_effects().data();
      EXPECT_EQ(signature->families.empty(), !is_foreign) << kind.name;
    }
  }
  EXPECT_EQ(validation::trial_signatures().size(),
            reference::library_effects().size() + reference::foreign_effects().size());
  for (const validation::ConfoundedEffects& pair : validation::confounded_pairs()) {
    for (const std::string_view name : {pair.first, pair.second})
      EXPECT_TRUE(std::any_of(reference::library_effects().begin(), reference::library_effects().end(),
                              [&](const auto& kind) { return kind.name == name; }))
          << name;
  }
}

struct Tally : reference::Sink {
  void transfer(const reference::Transfer&) override {}
  void truth(const reference::Snapshot& s) override {
    const double heading = s.heading_rad();
    if (s.time_s > 0) turned[s.rate_rad_s.z() > 0] += std::abs(std::remainder(heading - heading_rad, 2 * M_PI));
    heading_rad = heading;
    deepest_m = std::max(deepest_m, s.position_m.z());
    pitch_rad[0] = std::min(pitch_rad[0], s.pitch_rad());
    pitch_rad[1] = std::max(pitch_rad[1], s.pitch_rad());
    const bool up = s.position_m.z() < 0.35;
    up_s = up ? up_s + 0.1 : 0;
    constexpr double kLongestSearch_s = 10;
    fixes_s += up && up_s > kLongestSearch_s ? 0.1 : 0;
  }
  double heading_rad = 0, deepest_m = 0, up_s = 0, fixes_s = 0;
  std::array<double, 2> turned{}, pitch_rad{};
};

struct Excitation {
  validation::MissionKind kind;
  int minutes;
  std::size_t number;
  double least_turns, least_fixes_s;
};
void PrintTo(const Excitation& wanted, std::ostream* out) {
  *out << wanted.minutes << " minutes, mission " << wanted.number;
}
class GapTrialExcitation : public testing::TestWithParam<Excitation> {};

TEST_P(GapTrialExcitation, TurnsBothWaysPitchesBothWaysAndFindsFixes) {
  const Excitation& wanted = GetParam();
  const reference::Mission mission = validation::trial_missions(wanted.kind, wanted.minutes).at(wanted.number);
  Tally tally;
  EXPECT_EQ(mission.duration_s, 60.0 * wanted.minutes);
  EXPECT_LT(mission.orders.back().from_s, mission.duration_s);
  ASSERT_FALSE(reference::run(mission, {}, 1, tally));
  for (const double turned : tally.turned) EXPECT_GT(turned, wanted.least_turns * 2 * M_PI);
  EXPECT_LT(tally.pitch_rad[0], -0.35);
  EXPECT_GT(tally.pitch_rad[1], 0.35);
  EXPECT_GT(tally.deepest_m, 2);
  EXPECT_GT(tally.fixes_s, wanted.least_fixes_s);
}

// A mission each, so that none takes long under sanitizers.
INSTANTIATE_TEST_SUITE_P(Usual, GapTrialExcitation,
                         testing::Values(Excitation{validation::MissionKind::usual, 10, 0, 5, 120},
                                         Excitation{validation::MissionKind::usual, 10, 1, 5, 120},
                                         Excitation{validation::MissionKind::usual, 10, 2, 5, 120}));
INSTANTIATE_TEST_SUITE_P(Brief, GapTrialExcitation,
                         testing::Values(Excitation{validation::MissionKind::brief, 3, 0, 1, 50},
                                         Excitation{validation::MissionKind::brief, 3, 1, 1, 50},
                                         Excitation{validation::MissionKind::brief, 3, 2, 1, 50}));

TEST(GapTrialMissions, ThePoorOnesAreStraightAndNoTwoMissionsOfAKindAreAlike) {
  for (const reference::Mission& mission : validation::trial_missions(validation::MissionKind::poor, 10)) {
    for (const reference::Order& order : mission.orders) {
      EXPECT_EQ(order.heading_rad, mission.orders.front().heading_rad);
      EXPECT_EQ(order.speed_m_s, mission.orders.front().speed_m_s);
    }
  }
  for (const validation::MissionKind kind :
       {validation::MissionKind::usual, validation::MissionKind::brief, validation::MissionKind::poor}) {
    const auto missions = validation::trial_missions(kind, 10);
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      EXPECT_NE(missions.at(static_cast<std::size_t>(a)).orders.at(0).heading_rad,
                missions.at(static_cast<std::size_t>(b)).orders.at(0).heading_rad);
      EXPECT_NE(missions.at(static_cast<std::size_t>(a)).start_ns,
                missions.at(static_cast<std::size_t>(b)).start_ns);
    }
  }
}

}  // namespace
}  // namespace navcal::cli
