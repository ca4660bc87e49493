#include "validation/cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>

#include "validation/missions.h"
#include "validation/confounded_effects.h"

namespace navcal::cli {
namespace {

TEST(GapTrialArms, ARoundIsAThirdNullsAndSeventeenRoundsGiveEachTargetItsCases) {
  std::map<TrialArm, int> cases;
  for (int number = 1; number <= 17 * kCasesPerRound; ++number) {
    EXPECT_EQ(ordinal_in_arm(number), cases[arm_of_case(number)]++) << number;
  }
  EXPECT_EQ(cases[TrialArm::nulls], 17 * 11);
  for (const TrialArm arm :
       {TrialArm::single, TrialArm::single_tenth, TrialArm::single_fifth, TrialArm::pairs, TrialArm::triples,
        TrialArm::brief, TrialArm::removed, TrialArm::foreign, TrialArm::poor}) {
    EXPECT_EQ(cases[arm], 34) << facts_of(arm).name;
  }
  for (const TrialArm arm : {TrialArm::nulls_6, TrialArm::single_half, TrialArm::single_double})
    EXPECT_EQ(cases[arm], 17) << facts_of(arm).name;
}

TEST(GapTrialArms, FactsStandAtTheirArm) {
  for (const TrialArmFacts& facts : trial_arms()) EXPECT_EQ(facts_of(facts.arm).name, facts.name);
}

TEST(GapTrialArms, NamesChooseAndUnknownOnesAreRefusedWithTheKnown) {
  EXPECT_EQ(trial_arms_named({}).size(), trial_arms().size());
  EXPECT_EQ(trial_arms_named({"singles"}).size(), 5U);
  EXPECT_EQ(trial_arms_named({"single-0.1", "foreign"}), (std::vector{TrialArm::single_tenth, TrialArm::foreign}));
  try {
    (void)trial_arms_named({"doubles"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("no arm doubles; there are nulls, nulls-6"), std::string::npos);
  }
  for (const int number : case_numbers({TrialArm::foreign}, 5)) EXPECT_EQ(arm_of_case(number), TrialArm::foreign);
}

TEST(GapTrialCases, TheSameSeedAndNumberGiveTheSameCaseAndOthersOthers) {
  for (int number = 1; number <= kCasesPerRound; ++number) {
    EXPECT_EQ(truth_text(drawn_case(7, number, 10), 7), truth_text(drawn_case(7, number, 10), 7));
    EXPECT_NE(drawn_case(7, number, 10).mission_seeds, drawn_case(8, number, 10).mission_seeds);
    EXPECT_NE(drawn_case(7, number, 10).mission_seeds, drawn_case(7, number + 1, 10).mission_seeds);
  }
}

TEST(GapTrialCases, EachHasAPlaceOfTheTrialAndClocksOfItsOwn) {
  std::set<int> places;
  std::set<double> slow;
  for (int number = 1; number <= 2 * kCasesPerRound; ++number) {
    const TrialCase drawn = drawn_case(7, number, 10, 4);
    places.insert(drawn.place_number);
    EXPECT_EQ(drawn.place.begin_ns, drawn_place(7, drawn.place_number).begin_ns);
    for (const double clock :
         {drawn.vehicle.clocks.compass, drawn.vehicle.clocks.card, drawn.vehicle.clocks.motor}) {
      EXPECT_LE(std::abs(clock), 0.01);
      slow.insert(clock);
    }
    // The vehicle is the same, wherever it swims.
    EXPECT_EQ(drawn_case(7, number, 10, 5).mission_seeds, drawn.mission_seeds);
  }
  EXPECT_EQ(places, (std::set<int>{0, 1, 2, 3}));
  EXPECT_EQ(slow.size(), 6U * kCasesPerRound);
}

TEST(GapTrialCases, AnArmComesThroughAllEffectsBeforeOneComesAgain) {
  for (const TrialArm arm : {TrialArm::single, TrialArm::single_tenth, TrialArm::removed, TrialArm::foreign}) {
    const auto kinds = arm == TrialArm::foreign ? trial::foreign_effects() : trial::library_effects();
    std::set<std::string> names;
    for (const int number : case_numbers({arm}, static_cast<int>(kinds.size())))
      names.insert(drawn_case(3, number, 10).effects.at(0).name);
    EXPECT_EQ(names.size(), kinds.size()) << facts_of(arm).name;
  }
}

TEST(GapTrialCases, EachArmHasWhatItIsFor) {
  for (int number = 1; number <= 4 * kCasesPerRound; ++number) {
    const TrialCase drawn = drawn_case(11, number, 10);
    std::set<std::string> names;
    for (const trial::Effect& effect : drawn.effects) names.insert(effect.name);
    const std::size_t wanted = drawn.arm == TrialArm::nulls || drawn.arm == TrialArm::nulls_6 ? 0
                               : drawn.arm == TrialArm::pairs                                 ? 2
                               : drawn.arm == TrialArm::triples                               ? 3
                                                                                              : 1;
    EXPECT_EQ(names.size(), wanted) << number;
    EXPECT_EQ(drawn.minutes, drawn.arm == TrialArm::brief ? 3 : 10);
    EXPECT_EQ(drawn.excluded, drawn.arm == TrialArm::removed ? *names.begin() : "");
    EXPECT_EQ(drawn.in_library(), drawn.arm != TrialArm::removed && drawn.arm != TrialArm::foreign);
  }
}

TEST(GapTrialCases, EverySecondPairIsEasilyConfounded) {
  const auto numbers = case_numbers({TrialArm::pairs}, 6);
  for (std::size_t i = 1; i < numbers.size(); i += 2) {
    const auto effects = drawn_case(5, numbers[i], 10).effects;
    const auto& twins = signature_of(effects.at(0).name)->twins;
    EXPECT_NE(std::find(twins.begin(), twins.end(), effects.at(1).name), twins.end());
  }
}

TEST(GapTrialCases, TheTruthHoldsTheToleranceToo) {
  for (const int number : case_numbers({TrialArm::single}, 34)) {
    const TrialCase drawn = drawn_case(2, number, 10);
    const trial::Effect& effect = drawn.effects.at(0);
    const trial::EffectKind& kind = *trial::find_effect(effect.name);
    const trial::Effect real = true_parameters(effect, drawn.vehicle);
    bool moved = false;
    for (const std::string_view key : kind.parameters) {
      const double off = real.parameters.find(key)->second - effect.parameters.find(key)->second;
      EXPECT_LT(std::abs(off), 5 * 0.02 * kind.size.typical) << effect.name << ' ' << key;
      moved |= std::abs(off) > 1e-6 * kind.size.typical;
    }
    EXPECT_TRUE(moved) << effect.name;
  }
}

TEST(GapTrialTwins, EveryEffectHasChannelsAndTwinsAreInTheLibrary) {
  for (const auto& kinds : {trial::library_effects(), trial::foreign_effects()}) {
    for (const trial::EffectKind& kind : kinds) {
      const TrialSignature* signature = signature_of(kind.name);
      ASSERT_NE(signature, nullptr) << kind.name;
      EXPECT_FALSE(signature->channels.empty()) << kind.name;
    }
  }
  EXPECT_EQ(trial_signatures().size(), trial::library_effects().size() + trial::foreign_effects().size());
  for (const TrialTwins& pair : confounded_pairs()) {
    for (const std::string_view name : {pair.first, pair.second})
      EXPECT_TRUE(std::any_of(trial::library_effects().begin(), trial::library_effects().end(),
                              [&](const auto& kind) { return kind.name == name; }))
          << name;
  }
}

struct Tally : trial::Sink {
  void transfer(const trial::Transfer&) override {}
  void truth(const trial::Snapshot& s) override {
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
  MissionKind kind;
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
  const trial::Mission mission = trial_missions(wanted.kind, wanted.minutes).at(wanted.number);
  Tally tally;
  EXPECT_EQ(mission.duration_s, 60.0 * wanted.minutes);
  EXPECT_LT(mission.orders.back().from_s, mission.duration_s);
  ASSERT_FALSE(trial::run(mission, {}, 1, tally));
  for (const double turned : tally.turned) EXPECT_GT(turned, wanted.least_turns * 2 * M_PI);
  EXPECT_LT(tally.pitch_rad[0], -0.35);
  EXPECT_GT(tally.pitch_rad[1], 0.35);
  EXPECT_GT(tally.deepest_m, 2);
  EXPECT_GT(tally.fixes_s, wanted.least_fixes_s);
}

// A mission each, so that none takes long under sanitizers.
INSTANTIATE_TEST_SUITE_P(Usual, GapTrialExcitation,
                         testing::Values(Excitation{MissionKind::usual, 10, 0, 5, 120},
                                         Excitation{MissionKind::usual, 10, 1, 5, 120},
                                         Excitation{MissionKind::usual, 10, 2, 5, 120}));
INSTANTIATE_TEST_SUITE_P(Brief, GapTrialExcitation,
                         testing::Values(Excitation{MissionKind::brief, 3, 0, 1, 50},
                                         Excitation{MissionKind::brief, 3, 1, 1, 50},
                                         Excitation{MissionKind::brief, 3, 2, 1, 50}));

TEST(GapTrialMissions, ThePoorOnesAreStraightAndNoTwoMissionsOfAKindAreAlike) {
  for (const trial::Mission& mission : trial_missions(MissionKind::poor, 10)) {
    for (const trial::Order& order : mission.orders) {
      EXPECT_EQ(order.heading_rad, mission.orders.front().heading_rad);
      EXPECT_EQ(order.speed_m_s, mission.orders.front().speed_m_s);
    }
  }
  for (const MissionKind kind : {MissionKind::usual, MissionKind::brief, MissionKind::poor}) {
    const auto missions = trial_missions(kind, 10);
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
