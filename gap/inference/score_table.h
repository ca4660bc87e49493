// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "gap/inference/effect_subset.h"

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

}  // namespace navcal::gap
