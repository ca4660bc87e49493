// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "validation/judge.h"

// Cases and answers that nobody drew or gave, so that every score can be reckoned by hand.
namespace navcal::cli::test {

/// A case of this arm; the effects have their typical strength in their first parameter.
inline validation::TrialCase made_up_case(validation::TrialArm arm, const std::vector<std::string>& effects) {
  validation::TrialCase made_up;
  while (validation::arm_of_case(made_up.number) != arm) ++made_up.number;
  made_up.arm = arm;
  for (const std::string& name : effects) {
    const reference::EffectKind& kind = *reference::find_effect(name);
    validation::TrialEffect& effect = made_up.effects.emplace_back(validation::TrialEffect{name});
    for (const std::string_view key : kind.parameters) effect.real.emplace(key, 0);
    effect.real[std::string(kind.parameters.front())] = kind.size.typical;
  }
  if (arm == validation::TrialArm::removed) made_up.excluded = effects.front();
  return made_up;
}

inline validation::TrialResult answered(validation::TrialCase drawn, validation::TrialAnswer answer) {
  validation::TrialResult result;
  result.drawn = std::move(drawn);
  result.answer = std::move(answer);
  result.answer_json = "{}";
  result.seconds = 3;
  return result;
}

inline validation::TrialAnswer named(const std::vector<std::string>& effects, double probability = 0.99) {
  validation::TrialAnswer answer;
  answer.verdict = validation::TrialVerdict::explained;
  for (const std::string& name : effects) answer.effects.push_back({name, probability, {}});
  return answer;
}

inline validation::TrialAnswer verdict(validation::TrialVerdict verdict) {
  validation::TrialAnswer answer;
  answer.verdict = verdict;
  return answer;
}

}  // namespace navcal::cli::test
