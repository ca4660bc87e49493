// SPDX-License-Identifier: Apache-2.0
#include "gap/design/next_mission.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "base/enum_name.h"
#include "base/parallel.h"
#include "gap/design/planner.h"
#include "gap/design/question.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Probability from which a set counts as still probable.
constexpr double kProbableFrom = 0.02;

std::vector<std::string> names_of(const EffectSubset& effects, const Question& question) {
  std::vector<std::string> names;
  for (const std::size_t effect : effects) names.push_back(question.names[effect]);
  return names;
}

void write_pairs(const Question& question, const Contribution& planned, NextMission& next) {
  const auto& sets = question.hypotheses;
  for (const Hypothesis& set : sets) {
    next.sets.push_back({names_of(set.effects, question), set.probability});
    if (next.sets.size() == 1) next.probability_now = set.probability;
  }
  const Eigen::MatrixXd gram = question.told_by(planned.gram);
  for (std::size_t a = 0; a < sets.size(); ++a) {
    for (std::size_t b = a + 1; b < sets.size(); ++b) {
      next.pairs.push_back({next.sets[a].effects, next.sets[b].effects,
                            expected_separation_nats(sets[a], sets[b], gram),
                            expected_separation_nats(sets[b], sets[a], gram)});
    }
  }
  next.probability_exact = probability_exact(sets, gram, question.named_from);
}

std::optional<double> shown(double strength) {
  constexpr double kLargestTold = 20;
  return strength < kLargestTold ? std::optional(strength) : std::nullopt;
}

void write_strengths(const Question& question, const Contribution& planned, NextMission& next) {
  const Eigen::VectorXd before =
      question.smallest_strengths(Eigen::MatrixXd::Zero(planned.gram.rows(), planned.gram.cols()));
  const Eigen::VectorXd after = question.smallest_strengths(planned.gram);
  const auto& tested = question.tested;
  for (std::size_t i = 0; i < tested.size();) {
    // The weakest parameter of each effect.
    Eigen::Index weakest = static_cast<Eigen::Index>(i);
    const std::size_t effect = tested[i].effect;
    for (; i < tested.size() && tested[i].effect == effect; ++i) {
      if (before[static_cast<Eigen::Index>(i)] > before[weakest]) weakest = static_cast<Eigen::Index>(i);
    }
    next.strengths.push_back({question.names[effect], tested[static_cast<std::size_t>(weakest)].parameter,
                              shown(before[weakest]), shown(after[weakest])});
  }
  const auto value = [](const std::optional<double>& strength) { return strength.value_or(1e9); };
  std::ranges::stable_sort(next.strengths,
                           [&](const auto& a, const auto& b) { return value(a.before) > value(b.before); });
}

std::string separating_sentence(const NextMission& next) {
  const auto weakest = std::ranges::min_element(next.pairs, [](const PlannedPair& a, const PlannedPair& b) {
    return std::min(a.separation_nats, a.reverse_nats) < std::min(b.separation_nats, b.reverse_nats);
  });
  const auto is_open = [](const PlannedSet& set) { return set.probability >= kProbableFrom; };
  if (std::ranges::count_if(next.sets, is_open) < 2) {
    return fmt::format(
        "The recordings leave one set probable, {} ({:.2f}). This mission of {:.1f} minutes tests it against the "
        "others: it stays the answer, if it is true, with probability {:.2f}.",
        set_text(next.sets.front().effects), next.probability_now, next.minutes(), next.probability_exact);
  }
  std::string closest;
  if (weakest != next.pairs.end()) {
    closest = fmt::format(" Hardest to tell apart: {} and {}, {:.0f} nats.", set_text(weakest->a),
                          set_text(weakest->b), std::min(weakest->separation_nats, weakest->reverse_nats));
  }
  if (next.decides) {
    return fmt::format(
        "This mission of {:.1f} minutes decides between {} sets of effects: the answer is exact with probability "
        "{:.2f}.{}",
        next.minutes(), next.sets.size(), next.probability_exact, closest);
  }
  return fmt::format(
      "No mission found within the limits decides between the {} sets of effects. This one of {:.1f} minutes "
      "separates them best: the answer is exact with probability {:.2f}.{}",
      next.sets.size(), next.minutes(), next.probability_exact, closest);
}

std::string covering_sentence(const NextMission& next) {
  if (next.newly_covered.empty()) {
    return "A cause outside the library is likely, and the recordings have seen all regimes that the limits "
           "allow: no mission within them shows more.";
  }
  return fmt::format(
      "A cause outside the library is likely. This mission of {:.1f} minutes visits {} regimes that no recording "
      "has seen: {}{}.",
      next.minutes(), next.newly_covered.size(),
      fmt::join(next.newly_covered.begin(),
                next.newly_covered.begin() +
                    static_cast<std::ptrdiff_t>(std::min<std::size_t>(5, next.newly_covered.size())),
                ", "),
      next.newly_covered.size() > 5 ? " and others" : "");
}

std::string sharpening_sentence(const NextMission& next) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, next.strengths.size()); ++i) {
    const DetectableStrength& each = next.strengths[i];
    parts.push_back(fmt::format("{} ({} of typical so far, {} with this mission)", each.effect,
                                strength_text(each.before), strength_text(each.after)));
  }
  return fmt::format(
      "No gap is known. This mission of {:.1f} minutes tests the effects that were tested least: {}.",
      next.minutes(), fmt::join(parts, ", "));
}

void write_sentence(NextMission& next) {
  switch (next.purpose) {
    case MissionPurpose::separate: next.sentence = separating_sentence(next); return;
    case MissionPurpose::cover: next.sentence = covering_sentence(next); return;
    case MissionPurpose::sharpen: next.sentence = sharpening_sentence(next); return;
  }
}

/// Whether each two sets that are still probable become distinguishable.
bool probable_are_apart(const NextMission& next) {
  const auto is_probable = [&](const std::vector<std::string>& effects) {
    return std::ranges::any_of(next.sets, [&](const PlannedSet& set) {
      return set.effects == effects && set.probability >= kProbableFrom;
    });
  };
  return std::ranges::all_of(next.pairs, [&](const PlannedPair& pair) {
    return !is_probable(pair.a) || !is_probable(pair.b) ||
           std::min(pair.separation_nats, pair.reverse_nats) >= kObservable_nats;
  });
}

/// Share by which another vehicle may take longer than the limit before it is said.
constexpr double kDurationLeeway = 1.05;

/// Whether the vehicle of each set, too, stays within the limits.
void check_paths(const Question& question, const Rehearser& rehearser, NextMission& next) {
  // Seconds more or less depend on the vehicle, and hurt nobody.
  config::MissionLimits with_leeway = next.limits;
  with_leeway.duration_s *= kDurationLeeway;
  for (const Hypothesis& set : question.hypotheses) {
    if (set.effects.empty()) continue;
    const std::string name = set_text(names_of(set.effects, question));
    try {
      const PlannedPath path = rehearser.path(next.mission, next.limits.duration_s + 60, &set);
      for (const std::string& text : violations(extremes_of(path, next.limits), with_leeway)) {
        next.remarks.push_back(fmt::format("a vehicle with {} would exceed a limit: {}", name, text));
      }
    } catch (const sim::UnstableVehicle&) {
      next.remarks.push_back(fmt::format("a vehicle with {} could not swim this mission", name));
    }
  }
}

std::string description_of(const NextMission& next) {
  switch (next.purpose) {
    case MissionPurpose::separate: return "Planned by navcal gap next to tell probable causes apart.";
    case MissionPurpose::cover: return "Planned by navcal gap next to visit regimes that no recording has seen.";
    case MissionPurpose::sharpen: break;
  }
  return "Planned by navcal gap next to test the effects that were tested least.";
}

}  // namespace

std::string set_text(const std::vector<std::string>& effects) {
  return effects.empty() ? "no effect" : fmt::format("{}", fmt::join(effects, " + "));
}

std::string strength_text(const std::optional<double>& strength) {
  return strength ? fmt::format("{:.2f}", *strength) : "not shown";
}

std::string_view name_of(MissionPurpose purpose) {
  return base::enum_name<MissionPurpose::sharpen>(purpose, {"separate", "cover", "sharpen"});
}

NextMission plan_next_mission(const Question& question, const Rehearser& rehearser,
                              const config::MissionLimits& limits, const Progress& progress) {
  const auto began = std::chrono::steady_clock::now();
  Planner planner(question, rehearser, limits, progress);
  RehearsedPlan best = planner.plan();
  NextMission next;
  next.purpose = question.purpose;
  next.limits = limits;
  next.mission = std::move(best.plan.composed.mission);
  next.mission.description = description_of(next);
  next.path = std::move(best.plan.path);
  next.extremes = extremes_of(next.path, limits);
  for (const PlacedSegment& each : best.plan.placed)
    next.manoeuvres.emplace_back(planner.segments()[each.segment].name);
  write_pairs(question, best.all, next);
  write_strengths(question, best.all, next);
  next.newly_covered = newly_covered(question.so_far.coverage, question.so_far.coverage + best.all.coverage);
  next.decides = next.purpose == MissionPurpose::separate && next.probability_exact >= 1 - kMostRivals &&
                 probable_are_apart(next);
  write_sentence(next);
  check_paths(question, rehearser, next);
  next.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return next;
}

NextMission plan_next_mission(const Study& study, const config::MissionLimits& limits, const Progress& progress) {
  if (!study.prepared || !study.found) {
    throw std::invalid_argument(study.diagnosis.remarks.empty() ? "the recording cannot be diagnosed"
                                                                : study.diagnosis.remarks.back());
  }
  progress("weighing the sets", 0);
  const Question question = question_of(study);
  const ReferenceRehearser rehearser({study.request.vehicle,
                                      study.library,
                                      study.prepared->bank.whitening,
                                      {study.prepared->mission.instruments, study.prepared->mission.field},
                                      curved_estimates(question, study.library),
                                      base::threads_or_cores(study.request.threads)});
  return plan_next_mission(question, rehearser, limits, progress);
}

}  // namespace navcal::gap
