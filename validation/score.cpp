// SPDX-License-Identifier: Apache-2.0
#include "validation/score.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>

namespace navcal::validation {
namespace {

using enum TrialArm;
using Arms = std::initializer_list<TrialArm>;

struct Judged {
  const TrialResult* result;
  TrialJudgement judgement;
};

/// Target of a score: at least, at most.
struct TrialTarget {
  std::optional<double> least{}, most{};
};
TrialTarget at_least(double share) { return {share, {}}; }
TrialTarget at_most(double share) { return {{}, share}; }

/// Which of the cases count, and whether one is a hit; an absent answer does not count.
using Question = std::function<std::optional<bool>(const Judged&)>;

/// Adds scores of `all`, cases that were judged.
class Table {
 public:
  Table(const std::vector<Judged>& all, std::vector<TrialScore>& scores) : all_(all), scores_(scores) {}

  [[nodiscard]] bool on_layouts() const {
    return !all_.empty() && all_.front().result->drawn.on_layout != nullptr;
  }
  void share(const std::string& name, TrialTarget target, Arms arms, const Question& question) {
    share(name, target, [&](const Judged& one) -> std::optional<bool> {
      const auto arm = one.result->drawn.arm;
      return std::ranges::find(arms, arm) == arms.end() ? std::nullopt : question(one);
    });
  }
  void share(const std::string& name, TrialTarget target, const Question& question) {
    parts(name, target, [&](const Judged& one) {
      const auto hit = question(one);
      return std::array{int{hit.value_or(false)}, int{hit.has_value()}};
    });
  }
  /// Sums of hits and cases, of which each one has several.
  void parts(const std::string& name, TrialTarget target,
             const std::function<std::array<int, 2>(const Judged&)>& of) {
    TrialScore score{name, "%", {}, 0, 0, {}, target.least, target.most};
    for (const Judged& one : all_) {
      const auto [hits, cases] = of(one);
      score.hits += hits;
      score.cases += cases;
    }
    if (score.cases > 0) {
      score.value = static_cast<double>(score.hits) / score.cases;
      score.interval = wilson(score.hits, score.cases);
    }
    scores_.push_back(std::move(score));
  }
  void value(const std::string& name, const std::string& unit, TrialTarget target, std::optional<double> value,
             std::size_t cases) {
    scores_.push_back({name, unit, value, 0, static_cast<int>(cases), {}, target.least, target.most});
  }

 private:
  const std::vector<Judged>& all_;
  std::vector<TrialScore>& scores_;
};

Question is(TrialOutcome outcome) {
  return [outcome](const Judged& one) { return one.judgement.outcome == outcome; };
}
std::optional<bool> is_right(const Judged& one) { return one.judgement.right; }
/// Whether an answer with names is exact; absent if no effect was named.
std::optional<bool> exact_of_named(const Judged& one) {
  const auto outcome = one.judgement.outcome;
  if (outcome == TrialOutcome::exact) return true;
  if (outcome == TrialOutcome::part || outcome == TrialOutcome::wrong) return false;
  return std::nullopt;
}
/// Pairs come by turns: any two, and two that are easily confounded.
Question exact_of_pairs(bool confounded) {
  return [confounded](const Judged& one) -> std::optional<bool> {
    if ((ordinal_in_arm(one.result->drawn.number) % 2 == 1) != confounded) return std::nullopt;
    return one.judgement.outcome == TrialOutcome::exact;
  };
}

void score_names(Table& table) {
  const Question exact = is(TrialOutcome::exact), wrong = is(TrialOutcome::wrong);
  table.share("nulls: flagged", at_most(0.02), {nulls}, [](const Judged& one) {
    return one.result->answer && !one.judgement.right && one.judgement.outcome != TrialOutcome::cannot_say;
  });
  table.share("nulls: an effect named", {}, {nulls}, wrong);
  table.share("nulls-6: an effect named", {}, {nulls_6}, wrong);
  table.share("single-1: most probable right", at_least(0.98), {single},
              [](const Judged& one) { return one.judgement.top_right.value_or(false); });
  table.share("single-1: truth considered", at_least(1), {single},
              [](const Judged& one) { return one.judgement.truth_considered.value_or(false); });
  table.share("single-1: exact of those named", {}, {single}, exact_of_named);
  table.share("single-1: unknown", {}, {single}, is(TrialOutcome::unknown));
  struct Strength {
    TrialArm arm;
    double exact;
  };
  for (const auto& [arm, least] :
       {Strength{single, 0.95}, Strength{single_double, 0.95}, Strength{single_half, 0.95},
        Strength{single_fifth, 0.8}, Strength{single_tenth, 1.0 / 3}}) {
    const std::string name(facts_of(arm).name);
    table.share(name + ": exact", at_least(least), {arm}, exact);
    if (table.on_layouts())
      table.share(name + ": exact, or its class", {}, {arm}, [](const Judged& one) {
        return one.judgement.outcome == TrialOutcome::exact || one.judgement.outcome == TrialOutcome::in_class;
      });
    table.share(name + ": wrong name", at_most(0.01), {arm}, wrong);
  }
  table.share("pairs: exact", at_least(0.9), {pairs}, exact);
  if (!table.on_layouts()) {
    table.share("pairs, any two: exact", {}, {pairs}, exact_of_pairs(false));
    table.share("pairs, easily confounded: exact", {}, {pairs}, exact_of_pairs(true));
  }
  table.share("triples: exact", at_least(0.75), {triples}, exact);
  table.share("short: exact", at_least(0.8), {brief}, exact);
  table.share("removed: unknown, or its class", at_least(0.85), {removed}, is_right);
  table.share("foreign: unknown", at_least(0.97), {foreign}, is_right);
  table.share("poor: wrong name", at_most(0), {poor}, wrong);
  table.share("poor: truth considered, where a gap is seen", at_least(1), {poor},
              [](const Judged& one) -> std::optional<bool> {
                if (one.judgement.outcome == TrialOutcome::no_gap) return std::nullopt;
                return one.judgement.truth_considered.value_or(false);
              });
}

void gather(const std::vector<Judged>& all, TrialScores& scores) {
  scores.outcomes.assign(trial_arms().size(), {});
  std::array<double, kCalibrationBins> right{};
  for (const auto& [result, judgement] : all) {
    const TrialArmFacts& facts = facts_of(result->drawn.arm);
    ++scores.outcomes[static_cast<std::size_t>(facts.arm)][static_cast<std::size_t>(judgement.outcome)];
    for (const TrialForecast& bet : judgement.bets) {
      const int bin = std::min(static_cast<int>(bet.probability * kCalibrationBins), kCalibrationBins - 1);
      TrialCalibrationBin& sums = scores.calibration[static_cast<std::size_t>(bin)];
      ++sums.bets;
      sums.mean_probability += bet.probability;
      right[static_cast<std::size_t>(bin)] += bet.right ? 1 : 0;
    }
    constexpr double kLeastStrength = 0.5;
    if (judgement.closed && facts.strength >= kLeastStrength) scores.closures.push_back(*judgement.closed);
  }
  for (std::size_t i = 0; i < right.size(); ++i) {
    TrialCalibrationBin& bin = scores.calibration[i];
    if (bin.bets == 0) continue;
    bin.mean_probability /= bin.bets;
    bin.share_right = right[i] / bin.bets;
  }
  for (const TrialArm arm : {single_tenth, single_fifth, single_half, single, single_double}) {
    TrialPower power{facts_of(arm).strength, 0, 0};
    for (const int cases : scores.outcomes[static_cast<std::size_t>(arm)]) power.cases += cases;
    power.hits = scores.outcomes[static_cast<std::size_t>(arm)][static_cast<std::size_t>(TrialOutcome::exact)];
    scores.power.push_back(power);
  }
}

void score_numbers(const std::vector<Judged>& all, const TrialScores& scores, Table& table) {
  int bets = 0;
  for (const TrialCalibrationBin& bin : scores.calibration) bets += bin.bets;
  table.value("probabilities: calibration error", "", at_most(0.03),
              bets > 0 ? std::optional(calibration_error(scores.calibration)) : std::nullopt,
              static_cast<std::size_t>(bets));
  table.value("closure: median", "%", at_least(0.98), quantile(scores.closures, 0.5), scores.closures.size());
  table.value("closure: 10th percentile", "%", at_least(0.95), quantile(scores.closures, 0.1),
              scores.closures.size());
  table.share("closure: the interval holds the truth", {0.9, 0.98},
              [](const Judged& one) { return one.judgement.covered; });
  table.share("strongest channel right", at_least(0.95),
              [](const Judged& one) { return one.judgement.channel_right; });
  const auto foreign = [](const Judged& one) { return one.result->drawn.arm == TrialArm::foreign; };
  table.share("source right: effects of the library", at_least(0.95),
              [&](const Judged& one) { return foreign(one) ? std::nullopt : one.judgement.source_right; });
  table.share("source right: outside the library", at_least(0.95),
              [&](const Judged& one) { return foreign(one) ? one.judgement.source_right : std::nullopt; });
  table.share("proposal follows the right quantity: outside the library", at_least(0.6),
              [](const Judged& one) { return one.judgement.family_right; });
  table.parts("parameters within 2 standard errors", at_least(0.95), [](const Judged& one) {
    return std::array{one.judgement.parameters_within, one.judgement.parameters};
  });
  std::vector<double> seconds;
  for (const Judged& one : all) {
    if (one.result->answer && !one.result->first_of_its_kind) seconds.push_back(one.result->seconds);
  }
  table.value("time of a diagnosis: median", "s", at_most(10), quantile(seconds, 0.5), seconds.size());
  table.value("time of a diagnosis: 90th percentile", "s", {}, quantile(seconds, 0.9), seconds.size());
  table.share("no answer", at_most(0), is(TrialOutcome::failed));
}

}  // namespace

std::array<double, 2> wilson(int hits, int cases) {
  if (cases == 0) return {0, 1};
  constexpr double z = 1.959963984540054;
  const double n = cases, p = hits / n, z2 = z * z / n;
  const double middle = (p + z2 / 2) / (1 + z2);
  const double half = z / (1 + z2) * std::sqrt(p * (1 - p) / n + z2 / (4 * n));
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

std::optional<bool> TrialScore::met() const {
  if (!value || (!least && !most)) return std::nullopt;
  if (interval && cases < kLeastCasesToJudge) return std::nullopt;
  return (!least || *value >= *least) && (!most || *value <= *most);
}

double calibration_error(std::span<const TrialCalibrationBin> bins) {
  double sum = 0, bets = 0;
  for (const TrialCalibrationBin& bin : bins) {
    sum += bin.bets * std::abs(bin.mean_probability - bin.share_right);
    bets += bin.bets;
  }
  return bets > 0 ? sum / bets : 0;
}

TrialScores trial_scores(std::span<const TrialResult> results) {
  std::vector<Judged> all;
  for (const TrialResult& result : results) all.push_back({&result, judged(result)});
  TrialScores scores;
  scores.cases = static_cast<int>(all.size());
  gather(all, scores);
  Table table(all, scores.scores);
  score_names(table);
  score_numbers(all, scores, table);
  if (table.on_layouts()) std::erase_if(scores.scores, [](const TrialScore& score) { return score.cases == 0; });
  return scores;
}

}  // namespace navcal::validation
