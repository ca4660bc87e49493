// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/score_table.h"

#include <algorithm>

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
  return std::max_element(scores_.begin(), scores_.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::vector<EffectSubset> ScoreTable::leading(std::size_t size, std::size_t count) const {
  std::vector<EffectSubset> subsets;
  for (const auto& [subset, score] : scores_) {
    if (subset.size() == size) subsets.push_back(subset);
  }
  std::sort(subsets.begin(), subsets.end(),
            [&](const EffectSubset& a, const EffectSubset& b) { return scores_.at(a) > scores_.at(b); });
  if (subsets.size() > count) subsets.resize(count);
  return subsets;
}

}  // namespace navcal::gap
