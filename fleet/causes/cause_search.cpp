// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/cause_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "fleet/causes/limits.h"

namespace navcal::fleet {
namespace {

using Gain = PooledEvidence::Gain;

/// A cause with the evidence that it adds.
struct Scored {
  const PossibleCause* cause = nullptr;
  Gain gain;
};

class CauseSearch {
 public:
  CauseSearch(const PooledMissions& missions, unsigned threads, const CauseProgress& progress)
      : missions_(missions), threads_(threads), progress_(progress), possible_(possible_causes(missions)) {
    for (const PossibleCause& cause : possible_) {
      // An effect that ends again shows as one that begins, too; the last mission is then looked for among few.
      if (!cause.until) first_look_.push_back(&cause);
    }
  }

  CauseSearchResult run() {
    const double expected = 2 * static_cast<double>(missions_.vehicles().size() + missions_.days().size());
    while (add_best()) {
      progress_(0.5 * std::min(1.0, static_cast<double>(acting_.size()) / expected));
      if (outlier_vehicle().empty()) continue;
      // One cause that was not found at first may take the place of several that imitate it.
      exchange_all();
      if (std::string outlier = outlier_vehicle(); !outlier.empty()) return {{}, std::move(outlier)};
    }
    for (int round = 0; round < kExchangeRounds && exchange(); ++round) progress_(0.5 + 0.1 * (round + 1));
    if (std::string outlier = outlier_vehicle(); !outlier.empty()) return {{}, std::move(outlier)};
    return {described(), {}};
  }

 private:
  /// Gains of these causes over the model, most first; those beyond the bounds of a parameter are left out.
  [[nodiscard]] std::vector<Scored> scored(const PooledEvidence& evidence,
                                           const std::vector<const PossibleCause*>& causes) const {
    std::vector<Scored> all(causes.size());
    base::in_parallel(threads_, causes.size(), [&](std::size_t i) {
      all[i] = {causes[i], evidence.gain(*causes[i])};
    });
    std::erase_if(all, [](const Scored& each) { return !each.gain.is_within_bounds; });
    std::stable_sort(all.begin(), all.end(),
                     [](const Scored& a, const Scored& b) { return a.gain.log_odds > b.gain.log_odds; });
    return all;
  }

  /// The same effect of the same unit at all of its possible times.
  [[nodiscard]] std::vector<Scored> at_all_times(const PooledEvidence& evidence,
                                                 const PossibleCause& cause) const {
    std::vector<const PossibleCause*> times;
    for (const PossibleCause& each : possible_) {
      if (each.is_same_but_for_time(cause)) times.push_back(&each);
    }
    return scored(evidence, times);
  }

  /// The cause with the most evidence, at its best time.
  [[nodiscard]] std::optional<Scored> best(const PooledEvidence& evidence) const {
    const auto all = scored(evidence, first_look_);
    if (all.empty()) return std::nullopt;
    auto times = at_all_times(evidence, *all.front().cause);
    return times.empty() ? all.front() : times.front();
  }

  bool add_best() {
    const auto found = best(PooledEvidence(missions_, acting_));
    if (!found || found->gain.log_odds <= 0) return false;
    acting_.push_back({*found->cause, found->gain.strength});
    return true;
  }

  /// The vehicle, if any, that has more causes than a vehicle may have.
  [[nodiscard]] std::string outlier_vehicle() const {
    std::map<std::string, std::size_t> counts;
    for (const ActingCause& each : acting_) {
      if (each.cause.level == CauseLevel::vehicle && ++counts[each.cause.of] > kMostCausesPerVehicle)
        return each.cause.of;
    }
    return {};
  }

  [[nodiscard]] std::vector<ActingCause> all_but(std::size_t i) const {
    std::vector<ActingCause> others = acting_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    return others;
  }

  /// The same, and then adds what is still missing.
  bool exchange() {
    bool changed = exchange_all();
    while (outlier_vehicle().empty() && add_best()) changed = true;
    return changed;
  }

  /// Puts the best cause in the place of each, or none. Whether something changed.
  bool exchange_all() {
    bool changed = false;
    for (std::size_t i = acting_.size(); i-- > 0;) {
      const PooledEvidence evidence(missions_, all_but(i));
      const Gain now = evidence.gain(acting_[i].cause);
      const auto found = best(evidence);
      if (now.log_odds <= 0 && (!found || found->gain.log_odds <= 0)) {
        acting_.erase(acting_.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
      } else if (found && found->gain.log_odds > now.log_odds + kReplaced_nats) {
        acting_[i] = {*found->cause, found->gain.strength};
        changed = true;
      }
    }
    return changed;
  }

  std::vector<FoundCause> described() const {
    const PooledEvidence all(missions_, acting_);
    std::vector<FoundCause> found;
    for (std::size_t i = 0; i < acting_.size(); ++i) {
      FoundCause cause{acting_[i], 0, 0, 0, all.mean_of(i), all.std_of(i), {}};
      describe(PooledEvidence(missions_, all_but(i)), cause);
      found.push_back(std::move(cause));
      progress_(0.8 + 0.2 * static_cast<double>(i + 1) / static_cast<double>(acting_.size()));
    }
    return found;
  }

  /// Probabilities of a cause and of what could be in its place, the others kept.
  void describe(const PooledEvidence& others, FoundCause& found) const {
    const PossibleCause& own = found.acting.cause;
    std::vector<Scored> all = scored(others, first_look_);
    std::erase_if(all, [&](const Scored& each) { return each.cause->is_same_but_for_time(own); });
    const std::vector<Scored> times = at_all_times(others, own);
    all.insert(all.end(), times.begin(), times.end());
    double greatest = 0;
    for (const Scored& each : all) greatest = std::max(greatest, each.gain.log_odds);
    double sum = std::exp(-greatest);  // no cause
    struct Sum {
      const PossibleCause* most = nullptr;
      double share = 0, most_share = 0;
    };
    std::map<std::tuple<std::size_t, CauseLevel, std::string>, Sum> by_cause;
    for (const Scored& each : all) {
      const double share = std::exp(each.gain.log_odds - greatest);
      sum += share;
      Sum& of = by_cause[{each.cause->effect, each.cause->level, each.cause->of}];
      of.share += share;
      if (share > of.most_share) {
        of.most_share = share;
        of.most = each.cause;
      }
      if (each.cause->missions == own.missions && each.cause->is_same_but_for_time(own)) {
        found.log_odds = each.gain.log_odds;
        found.probability_of_time = share;
      }
    }
    for (const auto& [key, of] : by_cause) {
      if (of.most != nullptr && of.most->is_same_but_for_time(own)) {
        found.probability = of.share / sum;
        found.probability_of_time /= of.share;
      } else if (of.most != nullptr && of.share / sum >= kAlternativeFrom) {
        found.alternatives.push_back({*of.most, of.share / sum});
      }
    }
    std::ranges::stable_sort(found.alternatives, std::ranges::greater(), &Alternative::probability);
  }

  const PooledMissions& missions_;
  unsigned threads_;
  const CauseProgress& progress_;
  std::vector<PossibleCause> possible_;
  std::vector<const PossibleCause*> first_look_;
  std::vector<ActingCause> acting_;
};

}  // namespace

CauseSearchResult find_causes(const PooledMissions& missions, unsigned threads, const CauseProgress& progress) {
  return CauseSearch(missions, threads, progress).run();
}

}  // namespace navcal::fleet
