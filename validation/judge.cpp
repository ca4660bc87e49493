// SPDX-License-Identifier: Apache-2.0
#include "validation/judge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/confounded_effects.h"

namespace navcal::validation {
namespace {

/// Least probability of a candidate that counts. Hundreds of improbable ones would improve any calibration error.
constexpr double kLeastBet = 0.05;

bool holds(const std::vector<reference::Effect>& effects, std::string_view name) {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& effect) { return effect.name == name; });
}

bool holds(const std::vector<TrialFinding>& findings, std::string_view name) {
  return std::any_of(findings.begin(), findings.end(), [&](const auto& finding) { return finding.name == name; });
}

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

TrialOutcome outcome_of(const TrialCase& drawn, const TrialAnswer& answer) {
  if (answer.verdict == TrialVerdict::no_gap) return TrialOutcome::no_gap;
  if (answer.verdict == TrialVerdict::unknown) return TrialOutcome::unknown;
  const auto all_named = [&](auto condition) {
    return std::all_of(answer.effects.begin(), answer.effects.end(), condition);
  };
  if (const TrialSignature* removed = signature_of(drawn.excluded)) {
    const bool in_class = all_named([&](const TrialFinding& f) { return contains(removed->confounders, f.name); });
    return in_class ? TrialOutcome::in_class : TrialOutcome::wrong;
  }
  if (!drawn.in_library() || !all_named([&](const TrialFinding& f) { return holds(drawn.effects, f.name); }))
    return TrialOutcome::wrong;
  return answer.effects.size() == drawn.effects.size() ? TrialOutcome::exact : TrialOutcome::part;
}

bool right_for(TrialArm arm, const TrialJudgement& judgement) {
  switch (arm) {
    case TrialArm::nulls: return judgement.outcome == TrialOutcome::no_gap;
    case TrialArm::nulls_6:
      return judgement.outcome == TrialOutcome::no_gap || judgement.outcome == TrialOutcome::unknown;
    case TrialArm::foreign: return judgement.outcome == TrialOutcome::unknown;
    case TrialArm::removed:
      return judgement.outcome == TrialOutcome::unknown || judgement.outcome == TrialOutcome::in_class;
    case TrialArm::poor:
      if (judgement.outcome == TrialOutcome::unknown) return judgement.truth_considered.value_or(false);
      return judgement.outcome == TrialOutcome::exact;
    default: return judgement.outcome == TrialOutcome::exact;
  }
}

void judge_names(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  const auto& ranked = answer.effects.empty() ? answer.candidates : answer.effects;
  judgement.top_right = !ranked.empty() && holds(drawn.effects, ranked.front().name);
  judgement.truth_considered = std::all_of(drawn.effects.begin(), drawn.effects.end(), [&](const auto& effect) {
    return holds(answer.effects, effect.name) || holds(answer.candidates, effect.name) ||
           contains(answer.twins, effect.name);
  });
}

void judge_where(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  if (answer.verdict == TrialVerdict::no_gap) return;
  const auto is_first = [&](const std::vector<std::string>& named, auto TrialSignature::*right) {
    return !named.empty() &&
           std::any_of(drawn.effects.begin(), drawn.effects.end(), [&](const reference::Effect& effect) {
             const TrialSignature* signature = signature_of(effect.name);
             return signature != nullptr && contains(signature->*right, named.front());
           });
  };
  judgement.channel_right = is_first(answer.channels, &TrialSignature::channels);
  if (drawn.arm == TrialArm::foreign) {
    judgement.family_right =
        std::any_of(drawn.effects.begin(), drawn.effects.end(), [&](const reference::Effect& effect) {
          const TrialSignature* signature = signature_of(effect.name);
          return signature != nullptr &&
                 std::any_of(answer.families.begin(), answer.families.end(),
                             [&](const std::string& family) { return contains(signature->families, family); });
        });
  }
  judgement.source_right = is_first(answer.sources, &TrialSignature::sources);
}

void judge_parameters(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  for (const TrialFinding& finding : answer.effects) {
    count_within(finding, true_parameters({finding.name, {}}, drawn.vehicle).parameters,
                 judgement.parameters_within, judgement.parameters);
  }
}

void judge_probabilities(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  if (answer.verdict != TrialVerdict::explained) return;
  for (const TrialFinding& finding : answer.effects)
    judgement.bets.push_back({finding.probability, holds(drawn.effects, finding.name)});
  for (const TrialFinding& finding : answer.candidates) {
    if (finding.probability < kLeastBet || holds(answer.effects, finding.name)) continue;
    judgement.bets.push_back({finding.probability, holds(drawn.effects, finding.name)});
  }
}

}  // namespace

std::string_view name_of(TrialOutcome outcome) {
  constexpr std::array<std::string_view, kTrialOutcomes> kNames{"exact",   "part",   "class", "wrong name",
                                                                "unknown", "no gap", "failed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

void count_within(const TrialFinding& finding, const std::map<std::string, double, std::less<>>& truth,
                  int& within, int& all) {
  for (const auto& [key, value] : truth) {
    ++all;
    const auto estimate = finding.parameters.find(key);
    if (estimate == finding.parameters.end() || !estimate->second.std_error) continue;
    if (std::abs(estimate->second.value - value) <= 2 * *estimate->second.std_error) ++within;
  }
}

TrialJudgement judged(const TrialResult& result) {
  TrialJudgement judgement;
  if (!result.answer) return judgement;
  const TrialCase& drawn = result.drawn;
  const TrialAnswer& answer = *result.answer;
  judgement.outcome = outcome_of(drawn, answer);
  if (!drawn.effects.empty()) {
    if (drawn.in_library()) judge_names(drawn, answer, judgement);
    judge_where(drawn, answer, judgement);
  }
  if (judgement.outcome == TrialOutcome::exact) {
    judgement.closed = answer.closed;
    if (answer.closed_ci)
      judgement.covered = (*answer.closed_ci)[0] <= kTrueClosure && kTrueClosure <= (*answer.closed_ci)[1];
    judge_parameters(drawn, answer, judgement);
  }
  if (drawn.in_library() && drawn.arm != TrialArm::nulls_6) judge_probabilities(drawn, answer, judgement);
  judgement.right = right_for(drawn.arm, judgement);
  return judgement;
}

}  // namespace navcal::validation
