// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

std::string names(const Library& library, const std::vector<std::size_t>& effects) {
  std::vector<std::string_view> all;
  all.reserve(effects.size());
  for (const std::size_t effect : effects) all.push_back(library[effect].name);
  return fmt::format("{}", fmt::join(all, " + "));
}

/// Whether the effects leave no sign of a cause outside the library.
///
/// The remaining gap may be this vehicle's tolerances, if those estimated on the first mission explain it on
/// the others. Then the named effects must be larger than tolerances, and all other effects must be tolerances.
bool closes(const Grounds& grounds) {
  if (!grounds.closure.clear || grounds.closure.upper >= kClosedFrom) return true;
  const auto& best = grounds.found.best;
  for (std::size_t effect = 0; effect < grounds.library.size(); ++effect) {
    const double strength = strength_of(grounds.library, effect, best.mean);
    const bool named = std::ranges::find(best.effects, effect) != best.effects.end();
    if (named ? !(strength > kBeyondWideTolerance) : strength > kLargestUnnamed) return false;
  }
  return grounds.closure_by_all.clear && grounds.closure_by_all.upper >= kClosedFrom;
}

/// Total probability of the non-empty subsets that lack a member of `set`.
double rivals_of(const EffectSubset& set, const std::vector<Candidate>& candidates) {
  double together = 0;
  for (const Candidate& other : candidates) {
    const bool has_all = std::includes(other.effects.begin(), other.effects.end(), set.begin(), set.end());
    if (!other.effects.empty() && !has_all) together += other.probability;
  }
  return together;
}

bool is_left(const WhereEntry& entry) { return entry.p_value <= kUnexplainedBelow; }

void add_leftover(const Grounds& grounds, std::vector<std::string>& reasons) {
  for (const WhereEntry& left : grounds.leftover) {
    if (reasons.size() >= kMostReasons) break;
    if (!is_left(left)) continue;
    reasons.push_back(fmt::format("{} still follows {} by {:.2g} {}; vehicles without a gap show {:.2g}",
                                  left.channel, left.regime, left.gap, left.unit, left.floor));
  }
}

/// Adds the missions or blocks on which the effects do not raise the likelihood enough; true if they lower that of
/// other missions. Blocks of one mission need not tell the same.
bool add_held_out(const Grounds& grounds, const std::string& set, std::vector<std::string>& reasons) {
  const auto& gains_nats = grounds.held_out_nats;
  const double altogether = std::accumulate(gains_nats.begin(), gains_nats.end(), 0.0);
  const auto worse = std::ranges::count_if(gains_nats, [](double nats) { return nats < kHoldoutLoss_nats; });
  if (worse == 0 && altogether >= kHoldoutGain_nats) return false;
  const std::string_view parts = grounds.blocks ? "blocks of it that were left out" : "missions held out";
  reasons.push_back(worse == 0
                        ? fmt::format("{} explains this mission, but makes the fit of {} no better", set, parts)
                        : fmt::format("{} explains this mission, but makes the fit of {} of {} {} worse", set,
                                      worse, gains_nats.size(), parts));
  return worse > 0 && !grounds.blocks;
}

/// Reason why a closure is not enough. Far below zero its value is meaningless, so only the direction is
/// stated.
std::string closure_words(const PooledClosure& closure, const std::string& set) {
  if (closure.closed < kGrowsBelow) return fmt::format("with {} the gap grows instead of going away", set);
  const double percent = std::max(0.0, 100 * closure.closed);
  if (closure.lower < kGrowsBelow) {
    return fmt::format("with {} only {:.0f} % of the gap goes away (95 %: at most {:.0f} %)", set, percent,
                       100 * closure.upper);
  }
  return fmt::format("with {} only {:.0f} % of the gap goes away (95 %: {:.0f} to {:.0f} %)", set, percent,
                     100 * std::max(0.0, closure.lower), 100 * closure.upper);
}

/// Adds a reason when the subset is not clearly the most probable one.
void add_rivals(const Grounds& grounds, const std::string& set, std::vector<std::string>& reasons) {
  const auto& best = grounds.found.best;
  const auto& candidates = grounds.found.candidates;
  const auto first = std::ranges::find(candidates, best.effects, &Candidate::effects);
  const double probability = first != candidates.end() ? first->probability : 0;
  if (probability < kNamedFrom || rivals_of(best.effects, candidates) > kMostRivals) {
    std::string others;
    for (std::size_t i = 0; i < std::min<std::size_t>(candidates.size(), 3); ++i) {
      const Candidate& other = candidates[i];
      if (other.effects == best.effects) continue;
      others += fmt::format("{}{} ({:.2f})", others.empty() ? "" : ", ",
                            other.effects.empty() ? "no effect at all" : names(grounds.library, other.effects),
                            other.probability);
    }
    reasons.push_back(fmt::format("{} is the best candidate, but only with probability {:.2f}; others: {}", set,
                                  probability, others));
  }
}

/// Adds effects that the mission hardly shows, and strengths that no cause has; true for these.
bool add_strengths(const Grounds& grounds, std::vector<std::string>& reasons) {
  const auto& best = grounds.found.best;
  bool is_too_strong = false;
  for (std::size_t i = 0; i < best.effects.size(); ++i) {
    const std::size_t effect = best.effects[i];
    const double size = strength_of(grounds.library, effect, best.mean);
    if (grounds.found.expected_information_nats[i] < kObservable_nats) {
      reasons.push_back(fmt::format("{} hardly shows in this mission: at its usual strength by {:.1f} nats",
                                    grounds.library[effect].name, grounds.found.expected_information_nats[i]));
    }
    if (size < kLargestTolerance) {
      reasons.push_back(fmt::format("{} is the best candidate, but no stronger than within tolerance",
                                    grounds.library[effect].name));
    }
    if (size > kLargestStrength) {
      is_too_strong = true;
      reasons.push_back(fmt::format(
          "{} would have to be {} times as strong as usual, which speaks for something else that looks like it",
          grounds.library[effect].name,
          size < kLargestReported ? fmt::format("{:.1f}", size) : fmt::format("over {:.0f}", kLargestReported)));
    }
  }
  return is_too_strong;
}

}  // namespace

Judgement judge(const Grounds& grounds) {
  const auto& best = grounds.found.best;
  Judgement judgement;
  auto& reasons = judgement.reasons;
  if (best.effects.empty()) {
    add_leftover(grounds, reasons);
    judgement.verdict = reasons.empty() ? Verdict::no_gap : Verdict::unknown;
    judgement.kind = UnknownKind::outside;
    return judgement;
  }
  const std::string set = names(grounds.library, best.effects);
  bool is_outside = add_held_out(grounds, set, reasons);
  if (!closes(grounds)) reasons.push_back(closure_words(grounds.closure, set));
  is_outside = add_strengths(grounds, reasons) || is_outside || !closes(grounds);
  add_leftover(grounds, reasons);
  is_outside = is_outside || std::ranges::any_of(grounds.leftover, is_left);
  add_rivals(grounds, set, reasons);
  judgement.verdict = reasons.empty() ? Verdict::explained : Verdict::unknown;
  judgement.kind = is_outside ? UnknownKind::outside : UnknownKind::cannot_say;
  const auto& candidates = grounds.found.candidates;
  const auto none =
      std::ranges::find_if(candidates, [](const Candidate& candidate) { return candidate.effects.empty(); });
  const bool may_be_none = none != candidates.end() && none->probability > kNoGapBelow;
  const bool nothing_seen = grounds.where.empty() && std::ranges::none_of(grounds.leftover, is_left);
  if (!reasons.empty() && may_be_none && nothing_seen) {
    return {Verdict::no_gap, {}};
  }
  return judgement;
}

}  // namespace navcal::gap
