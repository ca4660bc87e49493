#pragma once

#include <string>
#include <vector>

#include "validation/judge.h"

// Cases and answers that nobody drew or gave, so that every score can be reckoned by hand.
namespace navcal::cli::test {

/// Of this arm; the effects have their typical strength in their first parameter.
inline TrialCase made_up_case(TrialArm arm, const std::vector<std::string>& effects) {
  TrialCase made_up;
  while (arm_of_case(made_up.number) != arm) ++made_up.number;
  made_up.arm = arm;
  for (const std::string& name : effects) {
    const trial::EffectKind& kind = *trial::find_effect(name);
    made_up.effects.push_back({name, {{std::string(kind.parameters.front()), kind.size.typical}}});
    trial::add(made_up.effects.back(), made_up.vehicle.departures);
  }
  if (arm == TrialArm::removed) made_up.excluded = effects.front();
  return made_up;
}

inline TrialResult answered(TrialCase drawn, TrialAnswer answer) {
  TrialResult result;
  result.drawn = std::move(drawn);
  result.answer = std::move(answer);
  result.answer_json = "{}";
  result.seconds = 3;
  return result;
}

inline TrialAnswer named(const std::vector<std::string>& effects, double probability = 0.99) {
  TrialAnswer answer;
  answer.verdict = TrialVerdict::explained;
  for (const std::string& name : effects) answer.effects.push_back({name, probability, {}});
  return answer;
}

inline TrialAnswer verdict(TrialVerdict verdict) {
  TrialAnswer answer;
  answer.verdict = verdict;
  return answer;
}

}  // namespace navcal::cli::test
