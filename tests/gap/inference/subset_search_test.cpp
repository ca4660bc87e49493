// SPDX-License-Identifier: Apache-2.0
// Properties of a search among five effects on short missions. How often a search is right is for `navcal gap
// trial` to say.
#include "gap/inference/subset_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gap/thresholds.h"
#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

/// The library, a mission, and what a search needs of it.
struct Searched {
  explicit Searched(std::string_view effects,
                    std::vector<std::string> held = {"hard_iron", "motor_field", "tilt_offset", "gps_latency",
                                                     "fin_backlash"})
      : library(test::library_of(held)),
        mission(test::prepared_mission({.effects = effects, .seconds = 90}, library, {12, 1, 2})),
        nominal(linearise(mission->model(library, 2), mission->at)),
        priors(fit_spike_widths(library, mission->bank.gram, mission->bank.scores)) {}

  [[nodiscard]] InferenceProblem problem(unsigned threads = 2) const {
    return {mission->model(library, threads), nominal, priors};
  }
  [[nodiscard]] SearchResult search(unsigned threads = 2) const { return SubsetSearch(problem(threads)).run(); }
  [[nodiscard]] EffectSubset subset(std::vector<std::string_view> names) const {
    EffectSubset all;
    for (const std::string_view name : names) all.push_back(test::index_of(library, name));
    std::sort(all.begin(), all.end());
    return all;
  }

  Library library;
  std::unique_ptr<Prepared> mission;
  Linearised nominal;
  Priors priors;
};

constexpr std::string_view kPair = "[motor_field]\nx_uT_per_A = 1\n[tilt_offset]\npitch_deg = 1\n";

/// What holds of every result.
void expect_consistent(const Searched& searched, const SearchResult& result) {
  ASSERT_FALSE(result.candidates.empty());
  double total = 0;
  bool has_none = false;
  for (std::size_t i = 0; i < result.candidates.size(); ++i) {
    const Candidate& candidate = result.candidates[i];
    total += candidate.probability;
    EXPECT_LE(candidate.effects.size(), kMostEffects);
    EXPECT_TRUE(std::is_sorted(candidate.effects.begin(), candidate.effects.end()));
    EXPECT_LE(candidate.log_odds, result.candidates[i == 0 ? 0 : i - 1].log_odds);
    for (const std::size_t effect : candidate.effects) EXPECT_TRUE(searched.library.holds(effect));
    if (candidate.effects.empty()) {
      has_none = true;
      EXPECT_EQ(candidate.log_odds, 0);
    }
    const double odds = candidate.probability / result.candidates.front().probability;
    EXPECT_NEAR(odds, std::exp(candidate.log_odds - result.candidates.front().log_odds), 1e-9);
  }
  EXPECT_TRUE(has_none);
  EXPECT_LE(total, 1 + 1e-9);
  EXPECT_GT(total, 0.9);
  EXPECT_EQ(result.candidates.front().effects, result.best.effects);
  EXPECT_EQ(result.candidates.front().log_odds, result.best.log_odds);
  EXPECT_EQ(result.expected_information_nats.size(), result.best.effects.size());
  EXPECT_EQ(result.best.mean.size(), static_cast<Eigen::Index>(searched.library.unknowns().size()));
  EXPECT_TRUE(result.best.std.allFinite());
}

TEST(SubsetSearch, FindsNothingInANominalMission) {
  const Searched searched("");
  const SearchResult result = searched.search();
  expect_consistent(searched, result);
  EXPECT_TRUE(result.best.effects.empty());
  EXPECT_GT(result.candidates.front().probability, 0.9);
}

TEST(SubsetSearch, FindsAPairAndNoThirdEffect) {
  const Searched searched(kPair);
  const SearchResult result = searched.search();
  expect_consistent(searched, result);
  EXPECT_EQ(result.best.effects, searched.subset({"motor_field", "tilt_offset"}));
  EXPECT_NEAR(result.best.mean[searched.library.first(test::index_of(searched.library, "motor_field"))], 1, 0.1);
  EXPECT_TRUE(unobservable_effects(result).empty());
  // Without the effects their parameters are held at zero.
  for (const Eigen::Index j : parameter_indices(searched.library, result.best.effects)) {
    EXPECT_NEAR(result.mean_without_effects[j], 0, 1e-6);
  }
}

TEST(SubsetSearch, FindsBacklashWhichIsNotLinear) {
  const Searched searched("[fin_backlash]\nwidth_deg = 3\n");
  const SearchResult result = searched.search();
  expect_consistent(searched, result);
  const auto& effects = result.best.effects;
  const std::size_t backlash = test::index_of(searched.library, "fin_backlash");
  EXPECT_NE(std::find(effects.begin(), effects.end(), backlash), effects.end());
}

TEST(SubsetSearch, AnEffectThatIsNotHeldIsNoCandidate) {
  const Searched searched(kPair, {"motor_field", "gps_latency"});
  const SearchResult result = searched.search();
  expect_consistent(searched, result);
  EXPECT_EQ(result.best.effects, searched.subset({"motor_field"}));
}

TEST(SubsetSearch, TheNumberOfThreadsChangesNoBit) {
  const Searched searched(kPair);
  const SearchResult one = searched.search(1), four = searched.search(4);
  ASSERT_EQ(one.candidates.size(), four.candidates.size());
  for (std::size_t i = 0; i < one.candidates.size(); ++i) {
    EXPECT_EQ(one.candidates[i].effects, four.candidates[i].effects);
    EXPECT_EQ(one.candidates[i].log_odds, four.candidates[i].log_odds);
  }
  EXPECT_EQ(one.best.mean, four.best.mean);
  EXPECT_EQ(one.best.std, four.best.std);
}

TEST(SubsetSearch, ReportsTheShareThatIsDone) {
  const Searched searched("", {"hard_iron"});
  InferenceProblem problem = searched.problem();
  std::vector<double> done;
  problem.progress = [&](double share) { done.push_back(share); };
  (void)SubsetSearch(problem).run();
  ASSERT_EQ(done.size(), kMostEffects);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(done.back(), 1);
}

TEST(NothingFound, IsTheEmptySubsetWithCertainty) {
  const Searched searched(kPair, {"hard_iron"});
  const SearchResult result = nothing_found(searched.problem());
  ASSERT_EQ(result.candidates.size(), 1U);
  EXPECT_TRUE(result.candidates.front().effects.empty());
  EXPECT_EQ(result.candidates.front().probability, 1);
  EXPECT_TRUE(result.best.effects.empty());
  EXPECT_EQ(result.best.log_odds, 0);
}

TEST(UnobservableEffects, AreThoseOfLittleExpectedInformation) {
  SearchResult result;
  result.best.effects = {3, 5, 8};
  result.expected_information_nats = {kObservable_nats - 1, kObservable_nats, kObservable_nats + 1};
  EXPECT_EQ(unobservable_effects(result), (EffectSubset{3}));
  EXPECT_TRUE(unobservable_effects(SearchResult{}).empty());
}

}  // namespace
}  // namespace navcal::gap
