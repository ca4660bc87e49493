#include "report/validation_words.h"

#include <fmt/format.h>

namespace navcal::cli {
namespace {

std::string quantity(double value, const std::string& unit) {
  if (unit == "%") return fmt::format("{:.1f} %", 100 * value);
  return unit.empty() ? fmt::format("{:.3f}", value) : fmt::format("{:.1f} {}", value, unit);
}

/// A target as people write it.
std::string goal(double value, const std::string& unit) {
  if (unit == "%") return fmt::format("{:.3g} %", 100 * value);
  return unit.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, unit);
}

}  // namespace

std::string value_text(const TrialScore& score) { return score.value ? quantity(*score.value, score.unit) : "-"; }

std::string count_text(const TrialScore& score) {
  if (score.interval) return fmt::format("{} of {}", score.hits, score.cases);
  return score.cases > 0 ? std::to_string(score.cases) : "none";
}

std::string interval_text(const TrialScore& score) {
  if (!score.interval) return "";
  return fmt::format("{:.1f} to {:.1f} %", 100 * (*score.interval)[0], 100 * (*score.interval)[1]);
}

std::string target_text(const TrialScore& score) {
  if (score.least && score.most) return goal(*score.least, score.unit) + " to " + goal(*score.most, score.unit);
  if (score.least) return "at least " + goal(*score.least, score.unit);
  if (score.most) return "at most " + goal(*score.most, score.unit);
  return "";
}

std::string met_text(const TrialScore& score) {
  const auto met = score.met();
  if (!met) return score.value && (score.least || score.most) ? "too few cases" : "";
  return *met ? "met" : "missed";
}

std::string targets_text(const TrialScores& scores) {
  int met = 0, targets = 0, untried = 0;
  for (const TrialScore& score : scores.scores) {
    if (!score.least && !score.most) continue;
    ++targets;
    met += int{score.met() == true};
    untried += int{!score.met()};
  }
  std::string text = fmt::format("{} of {} targets are met", met, targets);
  if (untried > 0) text += fmt::format(", {} could not be judged", untried);
  return text + ".";
}

std::string truth_words(const TrialCase& drawn) {
  std::string text;
  for (const trial::Effect& effect : drawn.effects) text.append(text.empty() ? "" : ", ").append(effect.name);
  if (text.empty()) return "no effect";
  return drawn.excluded.empty() ? text : text + ", of which the library is without";
}

std::string answer_words(const TrialResult& result) {
  if (!result.answer) return "no answer: " + result.failure;
  std::string text(name_of(result.answer->verdict));
  for (const TrialFinding& finding : result.answer->effects)
    text += fmt::format("{}{} ({:.3g})", &finding == result.answer->effects.data() ? ": " : ", ", finding.name,
                        finding.probability);
  return text;
}

bool is_mistake(const TrialResult& result) {
  const TrialJudgement judgement = judged(result);
  if (result.drawn.arm == TrialArm::nulls) return !judgement.right;
  return judgement.outcome == TrialOutcome::wrong || judgement.outcome == TrialOutcome::part ||
         judgement.outcome == TrialOutcome::failed;
}

bool is_miss(const TrialResult& result) {
  constexpr double kLeastStrength = 0.5;
  return !is_mistake(result) && facts_of(result.drawn.arm).strength >= kLeastStrength && !judged(result).right;
}

}  // namespace navcal::cli
