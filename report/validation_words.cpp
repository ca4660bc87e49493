// SPDX-License-Identifier: Apache-2.0
#include "report/validation_words.h"

#include <fmt/format.h>

namespace navcal::report {
namespace {

std::string quantity(double value, const std::string& unit) {
  if (unit == "%") return fmt::format("{:.1f} %", 100 * value);
  return unit.empty() ? fmt::format("{:.3f}", value) : fmt::format("{:.1f} {}", value, unit);
}

/// Text of a target.
std::string goal(double value, const std::string& unit) {
  if (unit == "%") return fmt::format("{:.3g} %", 100 * value);
  return unit.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, unit);
}

}  // namespace

std::string value_text(const validation::TrialScore& score) {
  return score.value ? quantity(*score.value, score.unit) : "-";
}

std::string count_text(const validation::TrialScore& score) {
  if (score.interval) return fmt::format("{} of {}", score.hits, score.cases);
  return score.cases > 0 ? std::to_string(score.cases) : "none";
}

std::string interval_text(const validation::TrialScore& score) {
  if (!score.interval) return "";
  return fmt::format("{:.1f} to {:.1f} %", 100 * (*score.interval)[0], 100 * (*score.interval)[1]);
}

std::string target_text(const validation::TrialScore& score) {
  if (score.least && score.most) return goal(*score.least, score.unit) + " to " + goal(*score.most, score.unit);
  if (score.least) return "at least " + goal(*score.least, score.unit);
  if (score.most) return "at most " + goal(*score.most, score.unit);
  return "";
}

std::string met_text(const validation::TrialScore& score) {
  const auto met = score.met();
  if (!met) return score.value && (score.least || score.most) ? "too few cases" : "";
  return *met ? "met" : "missed";
}

std::string targets_text(const validation::TrialScores& scores) {
  int met = 0, targets = 0, untried = 0;
  for (const validation::TrialScore& score : scores.scores) {
    if (!score.least && !score.most) continue;
    ++targets;
    met += int{score.met() == true};
    untried += int{!score.met()};
  }
  std::string text = fmt::format("{} of {} targets are met", met, targets);
  if (untried > 0) text += fmt::format(", {} could not be judged", untried);
  return text + ".";
}

std::string truth_words(const validation::TrialCase& drawn) {
  std::string text;
  for (const validation::TrialEffect& effect : drawn.effects)
    text.append(text.empty() ? "" : ", ").append(effect.full_name());
  if (text.empty()) return "no effect";
  return drawn.excluded.empty() ? text : text + ", with removed from the library";
}

std::string answer_words(const validation::TrialResult& result) {
  if (!result.answer) return "no answer: " + result.failure;
  std::string text(validation::name_of(result.answer->verdict));
  for (const validation::TrialFinding& finding : result.answer->effects)
    text += fmt::format("{}{} ({:.3g})", &finding == result.answer->effects.data() ? ": " : ", ", finding.name,
                        finding.probability);
  return text;
}

bool is_mistake(const validation::TrialResult& result) {
  const validation::TrialJudgement judgement = validation::judged(result);
  if (result.drawn.arm == validation::TrialArm::nulls) return !judgement.right;
  return judgement.outcome == validation::TrialOutcome::wrong ||
         judgement.outcome == validation::TrialOutcome::part ||
         judgement.outcome == validation::TrialOutcome::failed;
}

bool is_miss(const validation::TrialResult& result) {
  constexpr double kLeastStrength = 0.5;
  return !is_mistake(result) && validation::facts_of(result.drawn.arm).strength >= kLeastStrength &&
         !validation::judged(result).right;
}

}  // namespace navcal::report
