// SPDX-License-Identifier: Apache-2.0
#include "record/json/put_members.h"
#include "report/validation_report.h"

namespace navcal::report {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson json_of(const validation::TrialScore& score) {
  OrderedJson json{{"name", score.name}, {"value", score.value}, {"cases", score.cases}};
  // Shares are numbers from 0 to 1.
  if (score.unit == "s") json["unit"] = score.unit;
  if (score.interval) {
    json["hits"] = score.hits;
    json["interval"] = *score.interval;
  }
  json["at_least"] = score.least;
  json["at_most"] = score.most;
  json["met"] = score.met();
  return json;
}

OrderedJson json_of(const validation::TrialResult& result) {
  const validation::TrialJudgement judgement = validation::judged(result);
  OrderedJson json{{"case", result.drawn.number},  {"arm", validation::facts_of(result.drawn.arm).name},
                   {"sha256", result.seal.digest}, {"truth", result.seal.truth},
                   {"salt", result.seal.salt},     {"outcome", validation::name_of(judgement.outcome)},
                   {"right", judgement.right},     {"seconds", result.seconds}};
  // An answer that was parsed is written as JSON; one that could not be parsed is written as text.
  json["answer"] = result.answer ? OrderedJson::parse(result.answer_json) : OrderedJson();
  if (!result.failure.empty()) json["failure"] = result.failure;
  if (!result.answer && !result.answer_json.empty()) json["answer_text"] = result.answer_json;
  return json;
}

}  // namespace

std::string trial_json(const TrialReport& report) {
  OrderedJson json{{"seed", report.seed}, {"minutes", report.minutes}};
  if (const validation::LayoutTrial& on = report.on_layouts; on.layouts.empty()) {
    json["places"] = report.places;
  } else {
    for (const validation::NamedLayout& layout : on.layouts) json["layouts"].push_back(layout.name);
    NAVCAL_PUT_MEMBERS(json, on, vehicles, nominal, layout_error, unmodelled);
  }
  json.update(
      {{"asked_for", report.asked_for}, {"answered", report.results.size()}, {"ended_early", report.ended_early}});
  auto& scores = json["scores"] = OrderedJson::array();
  for (const validation::TrialScore& score : report.scores.scores) scores.push_back(json_of(score));
  auto& power = json["power"] = OrderedJson::array();
  for (const validation::TrialPower& point : report.scores.power)
    power.push_back({{"strength", point.strength}, {"exact", point.hits}, {"cases", point.cases}});
  auto& bins = json["calibration"] = OrderedJson::array();
  for (const validation::TrialCalibrationBin& bin : report.scores.calibration) {
    if (bin.bets == 0) continue;
    bins.push_back({{"probability", bin.mean_probability}, {"right", bin.share_right}, {"count", bin.bets}});
  }
  json["closures"] = report.scores.closures;
  auto& confusion = json["confusion"] = OrderedJson::object();
  for (const std::string& truth : report.confusion.truths) {
    for (const std::string& answer : report.confusion.answers) {
      if (const int count = report.confusion.count(truth, answer); count > 0) confusion[truth][answer] = count;
    }
  }
  auto& cases = json["cases"] = OrderedJson::array();
  for (const validation::TrialResult& result : report.results) cases.push_back(json_of(result));
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + '\n';
}

}  // namespace navcal::report
