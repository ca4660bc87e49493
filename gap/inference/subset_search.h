// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "gap/inference/local_evidence.h"
#include "gap/inference/problem.h"
#include "gap/inference/score_table.h"
#include "gap/inference/search.h"

namespace navcal::gap {

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
