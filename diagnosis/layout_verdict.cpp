// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/layout_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "diagnosis/limits.h"
#include "gap/verdict/answer.h"

namespace navcal::diagnosis {
namespace {

constexpr std::string_view kUnit = "noise power";

Floor floor_of_channel(std::span<const RecordingPower> nominal, std::size_t channel) {
  std::vector<double> powers;
  for (const RecordingPower& one : nominal) {
    const double power = one.of_channel[channel], readings = one.readings_of_channel[channel];
    if (power < 0) continue;
    powers.push_back(readings > 0 ? (readings * power + kFewReadings) / (readings + kFewReadings) : power);
  }
  return floor_of(powers);
}

/// Causes that are less probable are not worth a line, but for the leading ones.
constexpr double kLeastCandidate = 0.01;
constexpr std::size_t kLeastCandidates = 3;

/// A cause of the most probable set.
struct Member {
  std::size_t cause;
  std::vector<gap::Confusion> confused_with;  ///< what could stand in its place
  double probability = 0;                     ///< of all sets with it or one of those
  double lead_nats = 0;                       ///< over all sets without
};

Member member_of(const LayoutEvidence& evidence, std::size_t cause) {
  const auto& sets = evidence.found.sets;
  std::vector<std::size_t> alike{cause};
  // A set with a weak actuator in place of a dead one is no set without it.
  for (std::size_t other = 0; other < evidence.library.causes.size(); ++other)
    if (other != cause && are_one(evidence.library.causes[cause], evidence.library.causes[other]))
      alike.push_back(other);
  Member member{cause, {}, 0, std::numeric_limits<double>::infinity()};
  for (const ScoredSet& one : sets) {
    if (sets.front().log_odds - one.log_odds >= evidence.bank.leads.class_nats) break;
    if (!std::binary_search(one.causes.begin(), one.causes.end(), cause)) continue;
    for (const ScoredSet& swapped : sets) {
      const double behind_nats = one.log_odds - swapped.log_odds;
      if (behind_nats >= evidence.bank.leads.class_nats) break;
      std::vector<std::size_t> differing;
      std::ranges::set_symmetric_difference(one.causes, swapped.causes, std::back_inserter(differing));
      if (one.causes.size() != swapped.causes.size() || differing.size() != 2 ||
          std::ranges::find(differing, cause) == differing.end())
        continue;
      const std::size_t other = differing.front() == cause ? differing.back() : differing.front();
      const std::string words = evidence.library.causes[other].words();
      if (std::ranges::find(member.confused_with, words, &gap::Confusion::name) != member.confused_with.end())
        continue;
      if (std::ranges::find(alike, other) == alike.end()) alike.push_back(other);
      member.confused_with.push_back(
          {words, evidence.library.causes[cause].manoeuvre, std::max(behind_nats, 0.0)});
    }
  }
  for (const ScoredSet& one : sets) {
    const bool has =
        std::find_first_of(one.causes.begin(), one.causes.end(), alike.begin(), alike.end()) != one.causes.end();
    if (has) {
      member.probability += one.probability;
    } else {
      member.lead_nats = std::min(member.lead_nats, sets.front().log_odds - one.log_odds);
    }
  }
  return member;
}

std::string names_of(const std::vector<gap::EffectFinding>& effects) {
  std::vector<std::string> words;
  for (const gap::EffectFinding& one : effects) {
    words.push_back(one.words());
    for (const gap::Confusion& other : one.confused_with) words.back() += " or " + other.name;
  }
  return fmt::format("{}", fmt::join(words, " and "));
}

/// Log odds of the best set over no cause, nats.
double lead_of_best(const CauseSearchResult& found) {
  double lead_nats = found.sets.front().log_odds;
  for (const ScoredSet& one : found.sets) {
    if (one.causes.empty()) lead_nats -= one.log_odds;
  }
  return lead_nats;
}

/// Why a cause of the most probable set is not named, and of which kind its gap then is; empty where nothing
/// speaks against it.
std::optional<std::string> objection(const LayoutEvidence& evidence, const Member& member, std::size_t place,
                                     const gap::EffectFinding& finding, gap::UnknownKind& kind) {
  kind = gap::UnknownKind::cannot_say;
  const Cause& cause = evidence.library.causes[member.cause];
  const auto& of_channel = evidence.after.readings_of_channel;
  const double readings = std::accumulate(of_channel.begin(), of_channel.end(), 0.0);
  const double needed_nats =
      std::max(evidence.bank.leads.named_nats, kNamedShare * std::min(lead_of_best(evidence.found), readings)) +
      evidence.bank.chance_nats[member.cause];
  if (member.lead_nats < needed_nats) {
    return fmt::format("the most probable cause, {}, leads by {:.0f} nats only; a name takes {:.0f}",
                       cause.words(), member.lead_nats, needed_nats);
  }
  double presence = 0;
  // What an actuator can lose in full, as a dead one does, it can lose by any part.
  for (std::size_t i = 0; i < cause.parameters.size(); ++i) {
    const CauseParameter& parameter = cause.parameters[i];
    const gap::EffectParameterEstimate& estimate = finding.parameters[i];
    presence = std::max(presence, std::abs(estimate.value) / estimate.std_error);
    const double strength = std::abs(estimate.value) / parameter.typical;
    const bool is_loss = cause.is_of_actuator() && parameter.name == "scale" && estimate.value < 0;
    if (!is_loss && strength > kLargestStrength && parameter.high > kLargestStrength * parameter.typical) {
      kind = gap::UnknownKind::outside;
      return fmt::format("{} would have {:.0f} times its typical strength", cause.words(), strength);
    }
  }
  if (presence < kLeastPresence_sigma)
    return fmt::format("the strength of {} cannot be told from zero", cause.words());
  kind = gap::UnknownKind::outside;
  double gain_nats = 0, least_nats = 0;
  for (const ExplainedRecording& one : evidence.held_out) {
    const double here_nats = one.member_nats.empty() ? one.gain_nats : one.member_nats[place];
    gain_nats += here_nats;
    least_nats = std::min(least_nats, here_nats);
  }
  if (!evidence.held_out.empty() && (gain_nats < kHoldoutGain_nats || least_nats < kHoldoutLoss_nats)) {
    return fmt::format("{} does not improve the held-out recordings ({:+.1f} nats, {:+.1f} in the worst one)",
                       cause.words(), gain_nats, least_nats);
  }
  return std::nullopt;
}

/// Sets that are nearly as probable as the best one; none where fewer than two close the gap.
std::vector<gap::Alternative> alternatives_of(const LayoutEvidence& evidence) {
  constexpr std::size_t kMostAlternatives = 3;
  const auto& sets = evidence.found.sets;
  std::vector<gap::Alternative> all;
  for (const ScoredSet& one : sets) {
    if (sets.front().log_odds - one.log_odds >= evidence.bank.leads.named_nats ||
        one.probability < kLeastCandidate || all.size() == kMostAlternatives)
      break;
    if (one.causes.empty()) continue;
    const gap::Closure closure = evidence.closure(one.causes);
    if (closure.closed_ci && (*closure.closed_ci)[1] < gap::kClosedFrom) continue;
    const auto estimate = SetEvidence(evidence.found.changes, evidence.library).posterior(one.causes);
    all.push_back({{}, one.probability, closure.closed});
    for (const std::size_t cause : one.causes)
      all.back().effects.push_back(finding_of(evidence.library.causes[cause], one.probability, estimate));
  }
  if (all.size() < 2) all.clear();
  return all;
}

void say_unknown(gap::UnknownKind kind, const std::string& reason, const std::vector<gap::WhereEntry>& louder,
                 gap::Diagnosis& answer) {
  gap::write_unknown(kind, reason, answer);
  if (!reason.empty()) answer.unexplained.push_back(reason);
  for (const gap::WhereEntry& entry : louder) {
    answer.unexplained.push_back(
        fmt::format("{}: noise power {:.2f}, nominal {:.2f}", entry.channel, entry.gap, entry.floor));
  }
}

/// Without a floor: what leads may be what the layout leaves out of every vehicle.
void say_unconfirmed(gap::Diagnosis& answer) {
  const gap::EffectFinding& leading = answer.candidates.front();
  std::vector<std::string> sizes;
  for (const gap::EffectParameterEstimate& one : leading.parameters)
    sizes.push_back(fmt::format("{} {:.3g} +- {:.1g}", one.name, one.value, one.std_error));
  answer.verdict = gap::Verdict::unknown;
  answer.effects.clear();
  answer.sentence =
      fmt::format("Unconfirmed, without nominal recordings (--nominal): the most probable candidate is {}, {}.",
                  leading.words(), fmt::join(sizes, ", "));
  answer.unexplained.push_back("a gap cannot be told from what the layout leaves out of every vehicle");
}

void add_candidates(const LayoutEvidence& evidence, gap::Diagnosis& answer) {
  const SetEvidence of_sets(evidence.found.changes, evidence.library);
  const CauseSet& best = evidence.found.sets.front().causes;
  std::map<std::size_t, double> probabilities;
  for (const ScoredSet& one : evidence.found.sets) {
    for (const std::size_t cause : one.causes) probabilities[cause] += one.probability;
  }
  std::vector<std::size_t> leading;
  for (const ScoredSet& one : evidence.found.sets) {
    for (const std::size_t cause : one.causes) {
      const bool is_there = std::find(leading.begin(), leading.end(), cause) != leading.end();
      const bool is_worth_a_line = leading.size() < kLeastCandidates || probabilities[cause] >= kLeastCandidate;
      if (!is_there && is_worth_a_line) leading.push_back(cause);
    }
  }
  for (const std::size_t cause : leading) {
    const bool is_member = std::binary_search(best.begin(), best.end(), cause);
    answer.candidates.push_back(finding_of(evidence.library.causes[cause], probabilities[cause],
                                           of_sets.posterior(is_member ? best : CauseSet{cause})));
  }
  std::stable_sort(answer.candidates.begin(), answer.candidates.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
}

/// Lead that makes a gap, in addition to what nominal recordings have by chance.
double gap_nats(const NominalBank& bank) { return bank.leads.gap_nats * (bank.powers.size() == 1 ? 2 : 1); }

/// Log odds that are expected where one parameter has a size and nothing else has changed, nats.
double expected_gain(const LayoutEvidence& evidence, std::size_t cause, Eigen::Index column, double size) {
  Likelihood changes = evidence.found.changes;
  changes.score = changes.information.col(column) * size;
  changes.value = changes.norm - changes.score[column] * size / 2;
  return SetEvidence(std::move(changes), evidence.library).gain({cause});
}

/// Smallest size of a parameter that would have stood out; nullopt: none would. The expected log odds grow with
/// the size, so bisection finds it.
std::optional<double> least_visible_size(const LayoutEvidence& evidence, std::size_t cause,
                                         const CauseParameter& parameter) {
  constexpr double kMostTypical = 20;
  constexpr int kHalvings = 12;
  const double needed_nats = gap_nats(evidence.bank) + evidence.bank.chance_nats[cause];
  const double sign = parameter.high >= -parameter.low ? 1 : -1;
  double below = 0, size = kMostTypical * parameter.typical;
  if (!evidence.library.causes[cause].is_instrument)
    size = std::min(size, std::max(parameter.high, -parameter.low));
  const auto is_visible = [&](double value) {
    return expected_gain(evidence, cause, parameter.column, sign * value * parameter.per_unit) >= needed_nats;
  };
  if (!is_visible(size)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (below + size) / 2;
    (is_visible(middle) ? size : below) = middle;
  }
  return size;
}

/// Smallest visible size of each cause, by the parameter that shows least. The cause that shows best comes first.
std::vector<gap::LeastVisible> least_visible(const LayoutEvidence& evidence) {
  std::vector<gap::LeastVisible> all;
  const auto strength = [](const gap::LeastVisible& one) {
    return one.value ? *one.value / one.typical : std::numeric_limits<double>::infinity();
  };
  for (std::size_t cause = 0; cause < evidence.library.causes.size(); ++cause) {
    const Cause& of = evidence.library.causes[cause];
    std::optional<gap::LeastVisible> least;
    for (const CauseParameter& parameter : of.parameters) {
      if (parameter.is_switch()) continue;  // a dead actuator is a weak one
      gap::LeastVisible one{of.name, of.of, parameter.name, least_visible_size(evidence, cause, parameter),
                            parameter.typical};
      if (!least || strength(one) > strength(*least)) least = std::move(one);
    }
    if (least) all.push_back(std::move(*least));
  }
  std::stable_sort(all.begin(), all.end(),
                   [&](const auto& a, const auto& b) { return strength(a) < strength(b); });
  return all;
}

/// A sentence with the first of them, and with the number of causes that no size would have made visible.
std::string words_of(std::span<const gap::LeastVisible> least) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> shown;
  std::size_t hidden = 0;
  for (const gap::LeastVisible& one : least) {
    if (!one.value) ++hidden;
    if (one.value && shown.size() < kMost)
      shown.push_back(fmt::format("{} from {} {:.2g} on", one.words(), one.parameter, *one.value));
  }
  if (shown.empty()) return "No effect of the library would have stood out, however large.";
  return fmt::format("Would have stood out: {}. Of {} of {} effects no size would have.", fmt::join(shown, ", "),
                     hidden, least.size());
}

}  // namespace

gap::EffectFinding finding_of(const Cause& cause, double probability, const SetEvidence::Posterior& estimate) {
  gap::EffectFinding finding{};
  finding.name = cause.name;
  finding.of = cause.of;
  finding.probability = std::min(probability, 1.0);  // a sum of rounded shares
  finding.manoeuvre = cause.manoeuvre;
  for (const CauseParameter& parameter : cause.parameters) {
    const auto at = std::find(estimate.columns.begin(), estimate.columns.end(), parameter.column);
    const auto i = at - estimate.columns.begin();
    finding.parameters.push_back(
        {parameter.name, estimate.mean[i] / parameter.per_unit, estimate.std(i) / parameter.per_unit});
  }
  return finding;
}

std::vector<gap::WhereEntry> louder_channels(const RecordingPower& of, std::span<const RecordingPower> nominal) {
  std::vector<gap::WhereEntry> louder;
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    const double power = of.of_channel[c];
    if (power < 0) continue;
    Floor floor = floor_of_channel(nominal, c);
    // A mean square of few readings scatters by itself.
    if (of.readings_of_channel[c] > 0)
      floor.std = std::hypot(floor.std, floor.mean * std::sqrt(2 / of.readings_of_channel[c]));
    // One of several tells nothing of the scatter among them.
    if ((floor.count == 1 && nominal.size() > 1) || power <= floor.limit(kNominalFactor)) continue;
    const double z = (power - floor.mean) / std::max(floor.std, 0.02 * floor.mean);
    louder.push_back({std::string(identify::kChannelDescriptions[c].name), "whole recording", power, floor.mean,
                      std::string(kUnit), std::erfc(std::min(z, 30.0) / std::numbers::sqrt2)});
  }
  std::sort(louder.begin(), louder.end(),
            [](const auto& a, const auto& b) { return a.gap / a.floor > b.gap / b.floor; });
  return louder;
}

void write_verdict(const LayoutEvidence& evidence, gap::Diagnosis& answer) {
  const auto& [library, bank, found, after, held_out, closure, before] = evidence;
  const ScoredSet& best = found.sets.front();
  add_candidates(evidence, answer);
  const bool has_floor = !bank.powers.empty();
  const Floor floor = bank.floor();
  const auto louder = has_floor ? louder_channels(after, bank.powers) : std::vector<gap::WhereEntry>{};
  const double most_power = bank.leads.most_power.value_or(floor.limit(kNominalPowerFactor));
  const bool is_loud = has_floor && after.mean_square > most_power;
  const bool was_loud = is_loud || (has_floor && before > most_power);
  const double gain_nats = lead_of_best(found);
  double chance_nats = 0;
  for (const std::size_t cause : best.causes) chance_nats = std::max(chance_nats, bank.chance_nats[cause]);
  // The most probable set that has an effect.
  const auto leading =
      std::find_if(found.sets.begin(), found.sets.end(), [](const ScoredSet& one) { return !one.causes.empty(); });
  const bool leads = !best.causes.empty() && gain_nats >= gap_nats(bank) + chance_nats;
  const auto led_by = [&] {
    std::vector<std::string> words;
    for (const std::size_t cause : leading->causes) words.push_back(evidence.library.causes[cause].words());
    return fmt::format("{}", fmt::join(words, " and "));
  };
  // A lead in one recording that the held-out ones refute is an error of the model in the motion of that one,
  // where all together depart no more than nominal ones do.
  double held_out_nats = 0;
  for (const ExplainedRecording& one : held_out) held_out_nats += one.gain_nats;
  const auto count = static_cast<double>(held_out.size());
  const double mean_power = (before + count * answer.gap.pooled.before) / (1 + count);
  const bool is_refuted =
      has_floor && leads && held_out_nats < kHoldoutLoss_nats && mean_power < (floor.mean + most_power) / 2;
  if (louder.empty() && ((!was_loud && !leads) || is_refuted)) {
    answer.verdict = has_floor ? gap::Verdict::no_gap : gap::Verdict::unknown;
    answer.where.clear();
    const bool is_faint =
        leading != found.sets.end() && gain_nats + leading->log_odds - best.log_odds >= bank.leads.faint_nats;
    const std::string but = leads      ? fmt::format(" but for {}, which the held-out recordings refute", led_by())
                            : is_faint ? " but for a faint lead of " + led_by()
                                       : "";
    answer.sentence = "No effect stands out; without nominal recordings (--nominal) a gap cannot be ruled out.";
    if (has_floor) {
      answer.sentence = fmt::format("Nothing exceeds what nominal recordings show{}.", but);
      answer.least_visible = least_visible(evidence);
      answer.remarks.push_back(words_of(answer.least_visible));
    }
    return;
  }
  if (best.causes.empty()) {
    const auto closed = leading == found.sets.end() ? std::nullopt : closure(leading->causes).closed;
    if (!louder.empty() || closed.value_or(0) < gap::kClosedFrom)
      return say_unknown(gap::UnknownKind::outside, {}, louder, answer);
    return say_unknown(gap::UnknownKind::cannot_say, led_by() + " would explain it, but stands out too little",
                       louder, answer);
  }
  const auto estimate = SetEvidence(found.changes, library).posterior(best.causes);
  std::string reason;
  std::vector<std::string> not_named;
  auto kind = gap::UnknownKind::outside;
  for (std::size_t i = 0; i < best.causes.size(); ++i) {
    const Member member = member_of(evidence, best.causes[i]);
    gap::EffectFinding finding = finding_of(library.causes[member.cause], member.probability, estimate);
    finding.confused_with = member.confused_with;
    if (auto why = objection(evidence, member, i, finding, kind)) {
      not_named.push_back(*why);
    } else {
      answer.effects.push_back(std::move(finding));
    }
  }
  if (!has_floor) return say_unconfirmed(answer);
  const auto& closed_ci = answer.gap.pooled.closed_ci;
  const bool is_certain = !answer.effects.empty();
  const bool is_louder = !louder.empty() || is_loud;
  // The model's errors grow with the motion: beside a large gap, what is left of it counts, and not its size.
  const bool is_left_over = is_louder && !(closed_ci && (*closed_ci)[0] >= gap::kClosedFrom);
  const std::string explained_by = is_certain ? names_of(answer.effects) : "the best set of effects";
  if (!is_certain && (!is_left_over || kind == gap::UnknownKind::outside)) {
    reason = not_named.front();
  } else if (is_certain && !held_out.empty() && answer.gap.pooled.closed.value_or(1) <= 0) {
    reason = fmt::format("with {} the held-out recordings do not depart less", explained_by);
  } else if (is_left_over && !louder.empty()) {
    reason = fmt::format("{} leaves {} louder than nominal", explained_by, louder.front().channel);
  } else if (is_left_over) {
    reason =
        fmt::format("with {} the recording departs by {:.2f} times its noise power, nominal ones by {:.2f} times",
                    explained_by, after.mean_square, floor.mean);
  }
  if (is_certain || is_left_over) kind = gap::UnknownKind::outside;
  if (!reason.empty()) {
    answer.effects.clear();
    if (kind == gap::UnknownKind::cannot_say) answer.alternatives = alternatives_of(evidence);
    if (!answer.alternatives.empty()) kind = gap::UnknownKind::ambiguous;
    say_unknown(kind, reason, louder, answer);
    if (leads && kind == gap::UnknownKind::cannot_say)
      answer.sentence = fmt::format("There is a gap, but its cause cannot be said: {}.", reason);
    return;
  }
  answer.verdict = gap::Verdict::explained;
  answer.sentence = fmt::format("The gap is explained by {}.", names_of(answer.effects));
  for (const std::string& why : not_named) answer.remarks.push_back("not named beside it: " + why);
  if (is_louder)
    answer.remarks.push_back(fmt::format(
        "a small part of the gap is left: with {} the recording departs by {:.2f} times its noise power, "
        "nominal ones by {:.2f} times",
        explained_by, after.mean_square, floor.mean));
  if (held_out.empty())
    answer.remarks.emplace_back("no held-out recording was given (--holdout): the answer is weaker");
}

}  // namespace navcal::diagnosis
