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

bool holds(const std::vector<TrialEffect>& effects, std::string_view full_name) {
  return std::ranges::any_of(effects, [&](const auto& effect) { return is_same(effect, full_name); });
}

bool holds(const std::vector<TrialFinding>& findings, const TrialEffect& effect) {
  return std::ranges::any_of(findings, [&](const auto& finding) { return is_same(effect, finding.name); });
}

bool is_twin(const TrialAnswer& answer, const TrialEffect& effect) {
  return std::ranges::any_of(answer.twins, [&](const std::string& twin) { return is_same(effect, twin); });
}

template <class List>
bool contains(const List& list, std::string_view name) {
  return std::ranges::find(list, name) != list.end();
}

TrialOutcome outcome_of(const TrialCase& drawn, const TrialAnswer& answer) {
  if (answer.verdict == TrialVerdict::no_gap) return TrialOutcome::no_gap;
  if (answer.verdict == TrialVerdict::unknown) return TrialOutcome::unknown;
  if (answer.verdict == TrialVerdict::cannot_say) return TrialOutcome::cannot_say;
  const auto all_named = [&](auto condition) { return std::ranges::all_of(answer.effects, condition); };
  if (drawn.in_library() && all_named([&](const TrialFinding& f) { return holds(drawn.effects, f.name); }))
    return answer.effects.size() == drawn.effects.size() ? TrialOutcome::exact : TrialOutcome::part;
  const auto in_class = [&](const TrialFinding& finding) {
    return std::ranges::any_of(drawn.effects, [&](const TrialEffect& effect) {
      return is_confounded(effect, finding.name) || is_twin(answer, effect);
    });
  };
  const bool has_class = !drawn.excluded.empty() || (drawn.on_layout != nullptr && drawn.in_library());
  return has_class && all_named(in_class) ? TrialOutcome::in_class : TrialOutcome::wrong;
}

bool right_for(TrialArm arm, const TrialJudgement& judgement) {
  const bool is_open = judgement.outcome == TrialOutcome::unknown || judgement.outcome == TrialOutcome::cannot_say;
  switch (arm) {
    case TrialArm::nulls: return judgement.outcome == TrialOutcome::no_gap;
    case TrialArm::nulls_6:
      return judgement.outcome == TrialOutcome::no_gap || judgement.outcome == TrialOutcome::unknown;
    case TrialArm::foreign: return is_open;
    case TrialArm::removed: return is_open || judgement.outcome == TrialOutcome::in_class;
    case TrialArm::poor:
      if (judgement.outcome == TrialOutcome::unknown) return judgement.truth_considered.value_or(false);
      return judgement.outcome == TrialOutcome::exact;
    default: return judgement.outcome == TrialOutcome::exact;
  }
}

void judge_names(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  const auto& ranked = answer.effects.empty() ? answer.candidates : answer.effects;
  judgement.top_right = !ranked.empty() && holds(drawn.effects, ranked.front().name);
  judgement.truth_considered = std::ranges::all_of(drawn.effects, [&](const auto& effect) {
    return holds(answer.effects, effect) || holds(answer.candidates, effect) || is_twin(answer, effect);
  });
}

void judge_where(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  // Signatures are those of the reference vehicle.
  if (answer.verdict == TrialVerdict::no_gap || drawn.on_layout != nullptr) return;
  const auto is_first = [&](const std::vector<std::string>& named, auto TrialSignature::*right) {
    return !named.empty() && std::ranges::any_of(drawn.effects, [&](const TrialEffect& effect) {
      const TrialSignature* signature = signature_of(effect.name);
      return signature != nullptr && contains(signature->*right, named.front());
    });
  };
  judgement.channel_right = is_first(answer.channels, &TrialSignature::channels);
  if (drawn.arm == TrialArm::foreign) {
    judgement.family_right = std::ranges::any_of(drawn.effects, [&](const TrialEffect& effect) {
      const TrialSignature* signature = signature_of(effect.name);
      return signature != nullptr && std::ranges::any_of(answer.families, [&](const std::string& family) {
               return contains(signature->families, family);
             });
    });
  }
  judgement.source_right = is_first(answer.sources, &TrialSignature::sources);
}

/// The true parameters: those whose estimate lies within two standard errors, and all.
void judge_parameters(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  for (const TrialFinding& finding : answer.effects) {
    for (const TrialEffect& effect : drawn.effects) {
      if (!is_same(effect, finding.name)) continue;
      for (const auto& [key, value] : effect.real) {
        ++judgement.parameters;
        const auto estimate = finding.parameters.find(key);
        if (estimate == finding.parameters.end() || !estimate->second.std_error) continue;
        if (std::abs(estimate->second.value - value) <= 2 * *estimate->second.std_error)
          ++judgement.parameters_within;
      }
    }
  }
}

void judge_probabilities(const TrialCase& drawn, const TrialAnswer& answer, TrialJudgement& judgement) {
  if (answer.verdict != TrialVerdict::explained) return;
  for (const TrialFinding& finding : answer.effects)
    judgement.bets.push_back({finding.probability, holds(drawn.effects, finding.name)});
  for (const TrialFinding& finding : answer.candidates) {
    const auto is_named = [&](const TrialFinding& other) { return other.name == finding.name; };
    if (finding.probability < kLeastBet || std::ranges::any_of(answer.effects, is_named)) continue;
    judgement.bets.push_back({finding.probability, holds(drawn.effects, finding.name)});
  }
}

}  // namespace

std::string_view name_of(TrialOutcome outcome) {
  constexpr std::array<std::string_view, kTrialOutcomes> kNames{"exact",   "part",       "class",  "wrong name",
                                                                "unknown", "cannot say", "no gap", "failed"};
  return kNames[static_cast<std::size_t>(outcome)];
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
