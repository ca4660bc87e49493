// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/layout_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/limits.h"
#include "diagnosis/louder_channels.h"

namespace navcal::diagnosis {
namespace {

/// Causes that are less probable are not worth a line.
constexpr double kLeastCandidate = 0.01;

gap::EffectFinding finding_of(const Cause& cause, double probability, const Eigen::VectorXd& mean,
                              const Eigen::VectorXd& std) {
  gap::EffectFinding finding{};
  finding.name = cause.name;
  finding.of = cause.of;
  finding.probability = std::min(probability, 1.0);  // a sum of rounded shares
  finding.manoeuvre = cause.manoeuvre;
  for (const CauseParameter& parameter : cause.parameters) {
    finding.parameters.push_back(
        {parameter.name, mean[parameter.column] / parameter.per_unit, std[parameter.column] / parameter.per_unit});
  }
  return finding;
}

/// The probability of each cause is that of all sets which it belongs to.
std::map<std::size_t, double> probabilities_of_causes(const CauseSearchResult& found) {
  std::map<std::size_t, double> probabilities;
  for (const ScoredSet& one : found.sets) {
    for (const std::size_t cause : one.causes) probabilities[cause] += one.probability;
  }
  return probabilities;
}

/// Probability of no cause, and of all sets but that and the most probable one.
std::pair<double, double> none_and_rivals(const CauseSearchResult& found) {
  double none = 0, rivals = 0;
  for (const ScoredSet& one : found.sets) {
    if (one.causes.empty()) {
      none = one.probability;
    } else if (one.causes != found.sets.front().causes) {
      rivals += one.probability;
    }
  }
  return {none, rivals};
}

std::string names_of(const CauseSet& causes, const CauseLibrary& library) {
  std::vector<std::string> words;
  for (const std::size_t cause : causes) words.push_back(library.causes[cause].words());
  return fmt::format("{}", fmt::join(words, " and "));
}

/// How many standard errors the clearest parameter of a cause is from zero.
double presence_sigma(const Cause& cause, const CauseSearchResult& found) {
  double most = 0;
  for (const Eigen::Index column : cause.columns()) {
    most = std::max(most, std::abs(found.mean[column]) / found.std[column]);
  }
  return most;
}

/// Whether the estimate of a parameter is where the recording was linearised: elsewhere its evidence says nothing.
bool has_settled(const CauseParameter& parameter, const CauseSearchResult& found) {
  const Eigen::Index column = parameter.column;
  const double away = std::abs(found.mean[column] - found.best.at[column]);
  return away <= std::max(kSettledWithin * parameter.typical * parameter.per_unit,
                          kSettledWithin_sigma * found.std[column]);
}

/// Why the most probable set is not named although it is probable; empty where nothing speaks against it.
std::optional<std::string> objection(const LayoutEvidence& evidence, double rivals,
                                     const std::vector<gap::WhereEntry>& louder_after) {
  const ScoredSet& best = evidence.found.sets.front();
  const std::string names = names_of(best.causes, evidence.library);
  if (best.probability < kNamedFrom || rivals > kMostRivals) {
    return fmt::format("the most probable cause, {}, has a probability of {:.2f} only", names, best.probability);
  }
  if (!louder_after.empty()) {
    return fmt::format("{} leaves {} louder than nominal", names, louder_after.front().channel);
  }
  // Evidence compares sets. Where none of them describes the recording, the best one is no better than a bad
  // guess.
  const double misfit = misfit_of(evidence.found.best, best.log_odds);
  const Floor nominal = floor_of(evidence.bank.misfits);
  if (misfit > nominal.limit()) {
    return fmt::format(
        "with {} the recording departs by {:.1f} times its noise power, nominal ones by {:.1f} times", names,
        misfit, nominal.mean);
  }
  for (const std::size_t cause : best.causes) {
    if (presence_sigma(evidence.library.causes[cause], evidence.found) < kLeastPresence_sigma) {
      return fmt::format("the strength of {} cannot be told from zero", evidence.library.causes[cause].words());
    }
    for (const CauseParameter& parameter : evidence.library.causes[cause].parameters) {
      if (!has_settled(parameter, evidence.found)) {
        return fmt::format("the fit with {} does not settle", evidence.library.causes[cause].words());
      }
      const double strength =
          std::abs(evidence.found.mean[parameter.column]) / (parameter.typical * parameter.per_unit);
      if (strength > kLargestStrength && parameter.high > kLargestStrength * parameter.typical) {
        return fmt::format("{} would have {:.0f} times its typical strength", names, strength);
      }
    }
  }
  double gain_nats = 0;
  for (const ExplainedWindows& held : evidence.held_out) gain_nats += held.gain_nats;
  if (!evidence.held_out.empty() && gain_nats < kHoldoutGain_nats) {
    return fmt::format("{} does not improve the held-out recordings ({:+.1f} nats)", names, gain_nats);
  }
  return std::nullopt;
}

/// Causes that the recording cannot tell from those named.
void add_confusions(const SetEvidence& of_sets, const CauseLibrary& library, const CauseSet& named,
                    std::vector<gap::EffectFinding>& effects) {
  for (std::size_t i = 0; i < named.size(); ++i) {
    for (std::size_t other = 0; other < library.causes.size(); ++other) {
      if (std::binary_search(named.begin(), named.end(), other)) continue;
      const double apart_nats = of_sets.separation(named[i], {other});
      if (apart_nats >= kObservable_nats) continue;
      effects[i].confused_with.push_back(
          {library.causes[other].words(), library.causes[named[i]].manoeuvre, apart_nats});
    }
  }
}

void say_unknown(const std::string& reason, const std::vector<gap::WhereEntry>& louder, gap::Diagnosis& answer) {
  answer.verdict = gap::Verdict::unknown;
  answer.sentence = "There is a gap, but its cause is not known: " + reason + '.';
  answer.unexplained.push_back(reason);
  for (const gap::WhereEntry& entry : louder) {
    answer.unexplained.push_back(
        fmt::format("{}: noise power {:.2f}, nominal {:.2f}", entry.channel, entry.gap, entry.floor));
  }
}

}  // namespace

void write_verdict(const LayoutEvidence& evidence, gap::Diagnosis& answer) {
  const auto& [library, priors, bank, found, held_out] = evidence;
  const ScoredSet& best = found.sets.front();
  const auto probabilities = probabilities_of_causes(found);
  const SetEvidence of_sets(found.best.linear, library, priors);
  std::vector<std::pair<double, std::size_t>> order;
  for (const auto& [cause, probability] : probabilities) order.emplace_back(probability, cause);
  std::sort(order.rbegin(), order.rend());
  for (const auto& [probability, cause] : order) {
    if (probability < kLeastCandidate) break;
    const auto posterior = of_sets.posterior(best.causes.empty() ? CauseSet{cause} : best.causes);
    answer.candidates.push_back(finding_of(library.causes[cause], probability, posterior.mean, posterior.std));
  }
  const auto louder_after = louder_channels(found.best, bank);
  const auto [none, rivals] = none_and_rivals(found);
  const bool is_weak = none > kNoGapBelow && louder_after.empty() && best.probability < kNamedFrom;
  if (louder_after.empty() && (best.causes.empty() || is_weak)) {
    answer.verdict = gap::Verdict::no_gap;
    answer.where.clear();
    answer.sentence = "Nothing exceeds what nominal recordings show.";
    return;
  }
  if (best.causes.empty()) return say_unknown("no effect of the library explains it", louder_after, answer);
  if (const auto reason = objection(evidence, rivals, louder_after)) {
    return say_unknown(*reason, louder_after, answer);
  }
  answer.verdict = gap::Verdict::explained;
  for (const std::size_t cause : best.causes) {
    answer.effects.push_back(finding_of(library.causes[cause], probabilities.at(cause), found.mean, found.std));
  }
  add_confusions(of_sets, library, best.causes, answer.effects);
  answer.sentence = fmt::format("The gap is explained by {}.", names_of(best.causes, library));
  if (held_out.empty()) {
    answer.remarks.emplace_back("no held-out recording was given (--holdout): the answer is weaker");
  }
}

}  // namespace navcal::diagnosis
