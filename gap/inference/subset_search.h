// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "gap/inference/effect_subset.h"
#include "gap/inference/model_fit.h"
#include "gap/inference/problem.h"
#include "gap/inference/search.h"
#include "gap/inference/subset_evidence.h"

namespace navcal::gap {

/// Subsets that a search has scored, each with its best score (log evidence, nats): that of the subset's own
/// linearisation, or otherwise the first one that was set.
class ScoreTable {
 public:
  /// Does nothing for a subset that has a score.
  void set_initial(const EffectSubset& subset, double log_odds);
  /// The score is at least this, even after set_final(): the subset is judged better from another linearisation.
  void raise_floor(const EffectSubset& subset, double log_odds);
  /// The score of the subset's own linearisation, or of one that is as recent as what it is compared with.
  void set_final(const EffectSubset& subset, double log_odds);

  /// Has a subset had set_final()?
  [[nodiscard]] bool is_settled(const EffectSubset& subset) const { return settled_.contains(subset); }
  /// The subset of the highest score. Precondition: there is a score.
  [[nodiscard]] const EffectSubset& leader() const;
  /// At most `count` subsets of `size` effects, highest score first.
  [[nodiscard]] std::vector<EffectSubset> leading(std::size_t size, std::size_t count) const;
  [[nodiscard]] const std::map<EffectSubset, double>& scores() const { return scores_; }

 private:
  std::map<EffectSubset, double> scores_, floors_;
  std::set<EffectSubset> settled_;
};

/// Log evidence of subsets by one linearisation, minus the penalty of the parameters' bounds, plus the
/// simulated fit's gain over the linear model. The values of several linearisations may be compared.
class LocalEvidence {
 public:
  /// Keeps references to what `model` refers to. `beyond_linear`: ModelFit::beyond_linear of the subset about
  /// which it was linearised, nats.
  LocalEvidence(const LinearGaussianModel& model, double beyond_linear)
      : model_(model), beyond_linear_(beyond_linear), evidence_(model) {}

  [[nodiscard]] double operator()(const EffectSubset& subset) const {
    return evidence_(subset) - bound_penalty_nats(subset, model_) + beyond_linear_;
  }

 private:
  LinearGaussianModel model_;
  double beyond_linear_;
  SubsetEvidence evidence_;
};

/// Searches subsets of at most kMostEffects effects for the most probable one.
///
/// All singles and pairs are scored with the nominal Jacobian. The leading subsets of each size are simulated and
/// linearised again at their own estimate: second-order terms that are left would otherwise recruit innocent
/// effects. Each subset that was simulated scores its neighbours anew: subsets that are larger by one effect, and
/// subsets in which one effect is exchanged.
class SubsetSearch {
 public:
  /// Keeps a reference to `problem`.
  explicit SubsetSearch(const InferenceProblem& problem);

  /// Runs the search; to be called once.
  [[nodiscard]] SearchResult run();

 private:
  /// Scores no effect, and all singles and pairs with the nominal Jacobian.
  void seed();
  /// Simulates the leading subsets of one size, and all singles of curved effects.
  void expand(std::size_t size);
  /// Simulates leaders until the leader is one that was simulated.
  void settle_leader();
  /// Judges the leader and its neighbours with a Jacobian taken about the leader's estimate, until it stays.
  void refine_leader();
  /// Probabilities of all subsets that were scored.
  [[nodiscard]] SearchResult rank();

  /// A subset that was simulated scores itself and its neighbours.
  void take(ModelFit fit);
  void score_larger(const EffectSubset& subset, const LocalEvidence& here);
  void score_exchanged(const EffectSubset& subset, const LocalEvidence& here);

  const InferenceProblem& problem_;
  const Library& library_;
  std::vector<std::size_t> held_;  ///< effects of the library that may be a cause
  ScoreTable scores_;
  ModelFit best_;
};

}  // namespace navcal::gap
