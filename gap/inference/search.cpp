// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "base/parallel.h"
#include "gap/inference/subset_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

using Set = EffectSubset;

Set with(Set set, std::size_t effect) {
  set.insert(std::upper_bound(set.begin(), set.end(), effect), effect);
  return set;
}

Set without(Set set, std::size_t effect) {
  std::erase(set, effect);
  return set;
}

/// Whether one set becomes the other by adding, leaving out or exchanging one effect.
bool are_neighbours(const Set& a, const Set& b) {
  Set apart;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(apart));
  return apart.size() == 1 || (apart.size() == 2 && a.size() == b.size());
}

/// Sets that a search knows, each with the best word on it: that of its own linearisation, or the first that was
/// had.
class ScoreTable {
 public:
  void set_initial(const Set& set, double log_odds) { scores_.try_emplace(set, log_odds); }
  /// Seen better from elsewhere; its own linearisation does not make it less.
  void raise_floor(const Set& set, double log_odds) {
    const auto least = least_.try_emplace(set, log_odds).first;
    least->second = std::max(least->second, log_odds);
    const auto score = scores_.try_emplace(set, log_odds).first;
    score->second = std::max(score->second, log_odds);
  }
  void set_final(const Set& set, double log_odds) {
    const auto least = least_.find(set);
    scores_[set] = least == least_.end() ? log_odds : std::max(log_odds, least->second);
    settled_.insert(set);
  }
  /// The most probable of all; there is at least one.
  [[nodiscard]] const Set& leader() const {
    return std::max_element(scores_.begin(), scores_.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }
  /// Whether it was simulated, or seen from where nothing is older than what it is compared with.
  [[nodiscard]] bool is_settled(const Set& set) const { return settled_.contains(set); }
  [[nodiscard]] std::vector<Set> leading(std::size_t size, std::size_t count) const {
    std::vector<Set> sets;
    for (const auto& [set, score] : scores_) {
      if (set.size() == size) sets.push_back(set);
    }
    std::sort(sets.begin(), sets.end(), [&](const Set& a, const Set& b) { return scores_.at(a) > scores_.at(b); });
    if (sets.size() > count) sets.resize(count);
    return sets;
  }
  [[nodiscard]] const std::map<Set, double>& scores() const { return scores_; }

 private:
  std::map<Set, double> scores_, least_;
  std::set<Set> settled_;
};

/// How sets look from where one of them was simulated.
class LocalEvidence {
 public:
  LocalEvidence(const Linearised& linear, double beyond_linear, const Library& library, const Priors& priors)
      : linear_(linear),
        beyond_linear_(beyond_linear),
        library_(library),
        priors_(priors),
        evidence_(linear, library, priors) {}
  [[nodiscard]] double operator()(const Set& set) const {
    return evidence_(set) - bound_penalty_nats(set, linear_, library_, priors_) + beyond_linear_;
  }

 private:
  const Linearised& linear_;
  double beyond_linear_;
  const Library& library_;
  const Priors& priors_;
  SubsetEvidence evidence_;
};

/// Whether columns that were taken about one point serve at the other.
bool are_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Library& library) {
  for (Eigen::Index j = Library::kBiases; j < a.size(); ++j) {
    if (std::abs(a[j] - b[j]) > kLinearRange * library.unknowns()[static_cast<std::size_t>(j)].typical)
      return false;
  }
  return true;
}

}  // namespace

EffectSubset unobservable_effects(const SearchResult& result) {
  EffectSubset hidden;
  for (std::size_t i = 0; i < result.best.effects.size(); ++i) {
    if (result.expected_information_nats[i] < kObservable_nats) hidden.push_back(result.best.effects[i]);
  }
  return hidden;
}

SearchResult search(const Replay& replay, const Library& library, const Whitening& whitening,
                    const Linearised& nominal, const Priors& priors, unsigned threads,
                    const std::function<void(double)>& progress) {
  ScoreTable found;
  SearchResult result;
  result.best = fit_model({}, replay, library, whitening, nominal, priors, threads);
  found.set_final({}, result.best.log_odds);
  const double beyond_nominal = result.best.log_odds - LocalEvidence(nominal, 0, library, priors)({});
  const LocalEvidence judge(nominal, beyond_nominal, library, priors);
  std::vector<std::size_t> held;
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (library.holds(e)) held.push_back(e);
  }
  for (const std::size_t a : held) {
    found.set_initial({a}, judge({a}));
    for (const std::size_t b : held) {
      if (b > a) found.set_initial({a, b}, judge({a, b}));
    }
  }

  const auto guess_larger = [&](const Set& set, const LocalEvidence& here) {
    if (set.size() == kMostEffects) return;
    for (const std::size_t e : held) {
      if (std::find(set.begin(), set.end(), e) == set.end()) found.set_initial(with(set, e), here(with(set, e)));
    }
  };
  const auto take = [&](ModelFit tried) {
    const Set& set = tried.effects;
    found.set_final(set, tried.log_odds);
    const LocalEvidence here(tried.linear, tried.beyond_linear, library, priors);
    guess_larger(set, here);
    for (const std::size_t e : held) {
      if (std::find(set.begin(), set.end(), e) != set.end()) continue;
      // One member exchanged: seen from here, where what the others do is known better. The little play that a
      // vehicle within tolerance has looks unlike any long step; it is no merit of the set in which it was stepped
      // anew.
      for (const std::size_t member : set) {
        const Set exchanged = with(without(set, member), e);
        library.is_backlash(member) ? found.raise_floor(exchanged, here(exchanged))
                                    : found.set_initial(exchanged, here(exchanged));
      }
    }
    for (const std::size_t member : set) {
      if (library.is_backlash(member)) found.raise_floor(without(set, member), here(without(set, member)));
    }
    if (tried.log_odds > result.best.log_odds) result.best = std::move(tried);
  };
  for (std::size_t size = 1; size <= kMostEffects; ++size) {
    std::vector<Set> sets = found.leading(size, kLeadingSubsets);
    for (const std::size_t effect : held) {
      const bool there = std::find(sets.begin(), sets.end(), Set{effect}) != sets.end();
      if (size == 1 && library.is_curved(effect) && !there) sets.push_back({effect});
    }
    // As many at a time as there are threads: each holds a design of its own.
    for (std::size_t from = 0; from < sets.size(); from += threads) {
      std::vector<ModelFit> tried(std::min<std::size_t>(threads, sets.size() - from));
      base::in_parallel(threads, tried.size(), [&](std::size_t i) {
        tried[i] = fit_model(sets[from + i], replay, library, whitening, nominal, priors, 1);
      });
      for (ModelFit& one : tried) take(std::move(one));
    }
    progress(static_cast<double>(size) / kMostEffects);
  }

  // What was seen only from another set's place is not answered before it was simulated itself.
  for (std::size_t i = 0; i < kReconsideredSubsets; ++i) {
    const Set& leader = found.leader();
    if (found.is_settled(leader)) break;
    take(fit_model(leader, replay, library, whitening, nominal, priors, threads));
  }
  if (const Set& leader = found.leader(); leader != result.best.effects) {
    result.best = fit_model(leader, replay, library, whitening, nominal, priors, threads);
  }
  Eigen::VectorXd fresh_at = nominal.at;
  for (int i = 0; i < kRefinements && !result.best.effects.empty(); ++i) {
    if (const Eigen::VectorXd at = result.best.about; !are_near(at, fresh_at, library)) {
      result.best = refine(
          result.best.effects,
          relinearise(replay, library, whitening, std::move(result.best.linear), at, library.moving(), threads),
          replay, library, whitening, priors);
      fresh_at = at;
    }
    const LocalEvidence here(result.best.linear, result.best.beyond_linear, library, priors);
    found.set_final(result.best.effects, result.best.log_odds);
    guess_larger(result.best.effects, here);
    for (const auto& [set, score] : std::map(found.scores())) {
      if (!set.empty() && are_neighbours(set, result.best.effects)) found.set_final(set, here(set));
    }
    const Set leader = found.leader();
    if (leader == result.best.effects) break;
    result.best = fit_model(leader, replay, library, whitening, std::move(result.best.linear), priors, threads);
  }
  result.best.log_odds = found.scores().at(result.best.effects);
  const Priors others = without_members(priors, library, result.best.effects);
  result.mean_without_effects = bounded_posterior(nominal, library, others, {}).mean;

  const Evidence evidence = evidence_of(result.best.linear, priors);
  for (const std::size_t effect : result.best.effects) {
    const double strength = strength_of(library, effect, result.best.mean);
    const Eigen::VectorXd typical = result.best.mean / std::max(strength, 1e-9);
    result.expected_information_nats.push_back(
        evidence.separation(parameter_indices(library, {effect}), typical, {}));
  }

  double total = 0;
  for (const auto& [set, score] : found.scores()) total += std::exp(score - result.best.log_odds);
  const double none = found.scores().at({});
  for (const auto& [set, score] : found.scores()) {
    const double probability = std::exp(score - result.best.log_odds) / total;
    if (probability > 1e-4 || set.empty() || set == result.best.effects) {
      result.candidates.push_back({set, score - none, probability});
    }
  }
  std::sort(result.candidates.begin(), result.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.log_odds > b.log_odds; });
  result.best.log_odds -= none;
  return result;
}

SearchResult nothing_found(const Replay& replay, const Library& library, const Whitening& whitening,
                           const Linearised& nominal, const Priors& priors, unsigned threads) {
  SearchResult result;
  result.best = fit_model({}, replay, library, whitening, nominal, priors, threads);
  result.best.log_odds = 0;
  result.mean_without_effects = bounded_posterior(nominal, library, priors, {}).mean;
  result.candidates = {{{}, 0, 1}};
  return result;
}

}  // namespace navcal::gap
