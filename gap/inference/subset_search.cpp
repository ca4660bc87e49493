// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/subset_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/parallel.h"
#include "gap/thresholds.h"

namespace navcal::gap {

void ScoreTable::set_initial(const EffectSubset& subset, double log_odds) {
  scores_.try_emplace(subset, log_odds);
}

void ScoreTable::raise_floor(const EffectSubset& subset, double log_odds) {
  const auto floor = floors_.try_emplace(subset, log_odds).first;
  floor->second = std::max(floor->second, log_odds);
  const auto score = scores_.try_emplace(subset, log_odds).first;
  score->second = std::max(score->second, log_odds);
}

void ScoreTable::set_final(const EffectSubset& subset, double log_odds) {
  const auto floor = floors_.find(subset);
  scores_[subset] = floor == floors_.end() ? log_odds : std::max(log_odds, floor->second);
  settled_.insert(subset);
}

const EffectSubset& ScoreTable::leader() const {
  return std::ranges::max_element(scores_, [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::vector<EffectSubset> ScoreTable::leading(std::size_t size, std::size_t count) const {
  std::vector<EffectSubset> subsets;
  for (const auto& [subset, score] : scores_) {
    if (subset.size() == size) subsets.push_back(subset);
  }
  std::ranges::sort(subsets,
                    [&](const EffectSubset& a, const EffectSubset& b) { return scores_.at(a) > scores_.at(b); });
  if (subsets.size() > count) subsets.resize(count);
  return subsets;
}

namespace {

bool has(const EffectSubset& subset, std::size_t effect) {
  return std::ranges::find(subset, effect) != subset.end();
}

EffectSubset with(EffectSubset subset, std::size_t effect) {
  subset.insert(std::ranges::upper_bound(subset, effect), effect);
  return subset;
}

EffectSubset without(EffectSubset subset, std::size_t effect) {
  std::erase(subset, effect);
  return subset;
}

/// Whether one subset becomes the other by adding, leaving out or exchanging one effect.
bool are_neighbours(const EffectSubset& a, const EffectSubset& b) {
  EffectSubset apart;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(apart));
  return apart.size() == 1 || (apart.size() == 2 && a.size() == b.size());
}

/// Whether regressors that were taken about one point serve at the other.
bool are_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Library& library) {
  for (Eigen::Index j = Library::kBiases; j < a.size(); ++j) {
    if (std::abs(a[j] - b[j]) > kLinearRange * library.unknowns()[static_cast<std::size_t>(j)].typical)
      return false;
  }
  return true;
}

}  // namespace

SubsetSearch::SubsetSearch(const InferenceProblem& problem) : problem_(problem), library_(problem.model.library) {
  for (std::size_t effect = 0; effect < library_.size(); ++effect) {
    if (library_.holds(effect) && !has(problem.priors.not_judged, effect)) held_.push_back(effect);
  }
}

SearchResult SubsetSearch::run() {
  seed();
  for (std::size_t size = 1; size <= kMostEffects; ++size) {
    expand(size);
    problem_.progress(static_cast<double>(size) / kMostEffects);
  }
  settle_leader();
  refine_leader();
  return rank();
}

void SubsetSearch::seed() {
  best_ = fit_model({}, problem_);
  scores_.set_final({}, best_.log_odds);
  const LinearGaussianModel nominal = problem_.about(problem_.nominal);
  const double beyond_nominal = best_.log_odds - LocalEvidence(nominal, 0)({});
  const LocalEvidence here(nominal, beyond_nominal);
  for (const std::size_t a : held_) {
    scores_.set_initial({a}, here({a}));
    for (const std::size_t b : held_) {
      if (b > a) scores_.set_initial({a, b}, here({a, b}));
    }
  }
}

void SubsetSearch::expand(std::size_t size) {
  std::vector<EffectSubset> subsets = scores_.leading(size, kLeadingSubsets);
  for (const std::size_t effect : held_) {
    const bool there = std::ranges::find(subsets, EffectSubset{effect}) != subsets.end();
    if (size == 1 && library_.is_curved(effect) && !there) subsets.push_back({effect});
  }
  // One fit per thread at a time: each holds a design matrix of its own.
  const unsigned threads = problem_.model.threads;
  InferenceProblem on_one_thread = problem_;
  on_one_thread.model.threads = 1;
  for (std::size_t from = 0; from < subsets.size(); from += threads) {
    std::vector<ModelFit> fits(std::min<std::size_t>(threads, subsets.size() - from));
    base::in_parallel(threads, fits.size(),
                      [&](std::size_t i) { fits[i] = fit_model(subsets[from + i], on_one_thread); });
    for (ModelFit& fit : fits) take(std::move(fit));
  }
}

void SubsetSearch::take(ModelFit fit) {
  scores_.set_final(fit.effects, fit.log_odds);
  const LocalEvidence here(problem_.about(fit.linear), fit.beyond_linear);
  score_larger(fit.effects, here);
  score_exchanged(fit.effects, here);
  if (fit.log_odds > best_.log_odds) best_ = std::move(fit);
}

void SubsetSearch::score_larger(const EffectSubset& subset, const LocalEvidence& here) {
  if (subset.size() == kMostEffects) return;
  for (const std::size_t effect : held_) {
    if (!has(subset, effect)) scores_.set_initial(with(subset, effect), here(with(subset, effect)));
  }
}

void SubsetSearch::score_exchanged(const EffectSubset& subset, const LocalEvidence& here) {
  for (const std::size_t effect : held_) {
    if (has(subset, effect)) continue;
    for (const std::size_t member : subset) {
      // The other members' effects are known better here than in the nominal model. The long step about zero
      // does not describe the small backlash of a vehicle within tolerance. A gain by linearising backlash
      // again is therefore no merit of the subset.
      const EffectSubset exchanged = with(without(subset, member), effect);
      library_.is_backlash(member) ? scores_.raise_floor(exchanged, here(exchanged))
                                   : scores_.set_initial(exchanged, here(exchanged));
    }
  }
  for (const std::size_t member : subset) {
    if (library_.is_backlash(member)) scores_.raise_floor(without(subset, member), here(without(subset, member)));
  }
}

void SubsetSearch::settle_leader() {
  for (std::size_t i = 0; i < kReconsideredSubsets; ++i) {
    const EffectSubset& leader = scores_.leader();
    if (scores_.is_settled(leader)) break;
    take(fit_model(leader, problem_));
  }
  if (const EffectSubset& leader = scores_.leader(); leader != best_.effects) best_ = fit_model(leader, problem_);
}

void SubsetSearch::refine_leader() {
  Eigen::VectorXd linearised_at = problem_.nominal.at;
  for (int i = 0; i < kRefinements && !best_.effects.empty(); ++i) {
    if (const Eigen::VectorXd at = best_.about; !are_near(at, linearised_at, library_)) {
      best_ = refine(best_.effects, relinearise(problem_.model, std::move(best_.linear), at, library_.moving()),
                     problem_);
      linearised_at = at;
    }
    const LocalEvidence here(problem_.about(best_.linear), best_.beyond_linear);
    scores_.set_final(best_.effects, best_.log_odds);
    score_larger(best_.effects, here);
    for (const auto& [subset, score] : std::map(scores_.scores())) {
      if (!subset.empty() && are_neighbours(subset, best_.effects)) scores_.set_final(subset, here(subset));
    }
    const EffectSubset leader = scores_.leader();
    if (leader == best_.effects) break;
    best_ = fit_model(leader, problem_, std::move(best_.linear));
  }
  best_.log_odds = scores_.scores().at(best_.effects);
}

SearchResult SubsetSearch::rank() {
  SearchResult result;
  const Priors others = without_members(problem_.priors, library_, best_.effects);
  result.mean_without_effects = bounded_posterior({problem_.nominal, library_, others}, {}).mean;
  result.expected_information_nats = expected_information_nats(best_, problem_);
  double total = 0;
  for (const auto& [subset, score] : scores_.scores()) total += std::exp(score - best_.log_odds);
  const double none = scores_.scores().at({});
  for (const auto& [subset, score] : scores_.scores()) {
    const double probability = std::exp(score - best_.log_odds) / total;
    if (probability > kLeastCandidate || subset.empty() || subset == best_.effects) {
      result.candidates.push_back({subset, score - none, probability});
    }
  }
  std::ranges::sort(result.candidates, std::ranges::greater(), &Candidate::log_odds);
  result.best = std::move(best_);
  result.best.log_odds -= none;
  return result;
}

}  // namespace navcal::gap
