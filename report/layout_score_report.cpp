// SPDX-License-Identifier: Apache-2.0
#include "report/layout_score_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/validation_words.h"

namespace navcal::report {
namespace {

template <class On>
void each_arm(On on) {
  for (int arm = 0; arm < validation::kLayoutArms; ++arm)
    on(validation::name_of(static_cast<validation::LayoutArm>(arm)), static_cast<std::size_t>(arm));
}

template <class On>
void each_outcome(On on) {
  for (int outcome = 0; outcome < validation::kLayoutOutcomes; ++outcome)
    on(validation::name_of(static_cast<validation::LayoutOutcome>(outcome)), static_cast<std::size_t>(outcome));
}

nlohmann::ordered_json layout_score_object(const validation::TrialScore& score) {
  nlohmann::ordered_json object{{"name", score.name}, {"unit", score.unit}};
  object["value"] = score.value ? nlohmann::ordered_json(*score.value) : nlohmann::ordered_json();
  object["hits"] = score.hits;
  object["cases"] = score.cases;
  if (score.interval) object["interval"] = *score.interval;
  if (score.least) object["least"] = *score.least;
  if (score.most) object["most"] = *score.most;
  if (const auto met = score.met()) object["met"] = *met;
  return object;
}

}  // namespace

std::string layout_score_text(const validation::LayoutScores& scores) {
  std::string out = fmt::format("{} of {} cases answered\n\n", scores.answered, scores.cases);
  out += scores_text(scores.scores, 46);
  out += fmt::format("\n{:<12}", "");
  each_outcome([&](std::string_view name, std::size_t) { out += fmt::format("{:>12}", name); });
  out += '\n';
  each_arm([&](std::string_view name, std::size_t arm) {
    out += fmt::format("{:<12}", name);
    each_outcome([&](std::string_view, std::size_t outcome) {
      out += fmt::format("{:>12}", scores.outcomes[arm][outcome]);
    });
    out += '\n';
  });
  return out;
}

std::string layout_score_json(const validation::LayoutScores& scores) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array(), arms = nlohmann::ordered_json::object();
  for (const validation::TrialScore& score : scores.scores) rows.push_back(layout_score_object(score));
  each_arm([&](std::string_view name, std::size_t arm) {
    nlohmann::ordered_json counts = nlohmann::ordered_json::object();
    each_outcome([&](std::string_view outcome_name, std::size_t outcome) {
      counts[std::string(outcome_name)] = scores.outcomes[arm][outcome];
    });
    arms[std::string(name)] = counts;
  });
  const nlohmann::ordered_json all{
      {"cases", scores.cases}, {"answered", scores.answered}, {"scores", rows}, {"outcomes", arms}};
  return all.dump(2) + '\n';
}

}  // namespace navcal::report
