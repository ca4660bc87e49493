// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planner.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/parallel.h"
#include "sim/vehicle/body.h"

namespace navcal::gap {
namespace {

/// Error bound at which a mission that separates needs no more manoeuvres: about 80 nats between all pairs,
/// several times what decides, because predictions are not exact.
constexpr double kDecidedLog = -20;
/// Simulated missions after the greedy selection, and exchanges in each.
constexpr int kExchangeRounds = 2;
constexpr int kExchangesPerRound = 2;
/// Share of the range from which a manoeuvre heads back.
constexpr double kTurnBackFrom = 0.45;
constexpr std::size_t kMostManoeuvres = 60;

Contribution nothing(const Question& question) {
  const Eigen::Index n = question.unknowns;
  return {Eigen::MatrixXd::Zero(n, n), no_coverage()};
}

double heading_of_nth(std::size_t n) {
  // Three eighths of a circle further each time: all eight headings in turn, neighbours far apart.
  return std::remainder(0.75 * std::numbers::pi * static_cast<double>(n), 2 * std::numbers::pi);
}

std::vector<double> part_begins(const Plan& plan) {
  std::vector<double> begins_s;
  for (const std::size_t step : plan.composed.first_step) {
    begins_s.push_back(step < plan.path.step_began_s.size() ? plan.path.step_began_s[step] : plan.path.duration_s);
  }
  return begins_s;
}

}  // namespace

Planner::Planner(const Question& question, const Rehearser& rehearser, const config::MissionLimits& limits,
                 const Progress& progress)
    : question_(question), rehearser_(rehearser), limits_(limits), progress_(progress),
      regime_(rehearser.regime(limits)), alphabet_(alphabet(regime_)) {
  const auto cannot = [&](const Segment& segment) {
    return !rehearser_.can(compose({{0, 0}}, {segment}, regime_).mission);
  };
  std::erase_if(alphabet_, cannot);
  learn_alphabet();
  if (known_.empty()) {
    throw std::invalid_argument("no manoeuvre stays within the limits: allow more depth, speed or rate of turn");
  }
}

void Planner::learn_alphabet() {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < alphabet_.size(); ++i) all.push_back(i);
  learn_halves(all);
}

void Planner::learn_halves(const std::vector<std::size_t>& segments) {
  const auto middle = segments.begin() + std::ssize(segments) / 2;
  for (const auto& half :
       {std::vector<std::size_t>(segments.begin(), middle), std::vector<std::size_t>(middle, segments.end())}) {
    if (half.empty()) continue;
    progress_("manoeuvres", static_cast<double>(half.front()) / static_cast<double>(alphabet_.size()));
    try {
      learn(half);
    } catch (const sim::UnstableVehicle&) {
      // One of them upsets the vehicle.
      if (half.size() > 1) learn_halves(half);
    }
  }
}

void Planner::learn(const std::vector<std::size_t>& segments) {
  Plan plan;
  for (const std::size_t segment : segments) plan.placed.push_back({segment, heading_of_nth(plan.placed.size())});
  plan.composed = compose(plan.placed, alphabet_, regime_);
  plan.path = rehearser_.path(plan.composed.mission, 7200);
  const auto begins_s = part_begins(plan);
  const Rehearsal rehearsal = rehearser_.rehearse(plan.composed.mission, plan.path.duration_s, begins_s);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    PathExtremes extremes = extremes_of(plan.path, limits_, begins_s[i], begins_s[i + 1]);
    const double duration_s = extremes.duration_s;
    // Distances and sums are those of the mission in which the manoeuvre was learnt.
    extremes.range_m = extremes.duration_s = 0;
    extremes.energy_Wh.reset();
    if (!violations(extremes, limits_).empty() || !(duration_s > 0)) continue;
    known_.push_back(
        {segments[i], duration_s, {rehearsal.parts[i], coverage_of(plan.path, begins_s[i], begins_s[i + 1])}});
  }
}

std::optional<Plan> Planner::within_limits(std::vector<PlacedSegment> placed) const {
  Plan plan;
  plan.composed = compose(placed, alphabet_, regime_);
  plan.placed = std::move(placed);
  try {
    plan.path = rehearser_.path(plan.composed.mission, limits_.duration_s + 1);
  } catch (const sim::UnstableVehicle&) {
    return std::nullopt;
  }
  if (!violations(extremes_of(plan.path, limits_), limits_).empty()) return std::nullopt;
  return plan;
}

std::optional<Plan> Planner::extended(const Plan& plan, std::size_t segment) const {
  const auto begins_s = part_begins(plan);
  const auto row = std::min(static_cast<std::size_t>(begins_s.back() / kInterval_s), plan.path.time_s.size() - 1);
  const double north_m = plan.path.north_m[row], east_m = plan.path.east_m[row];
  const double home_rad = std::atan2(-east_m, -north_m);
  const double next_rad = heading_of_nth(plan.placed.size());
  std::vector<double> headings{home_rad};
  if (std::hypot(north_m, east_m) < kTurnBackFrom * limits_.range_m) headings.insert(headings.begin(), next_rad);
  for (const double heading_rad : headings) {
    std::vector<PlacedSegment> placed = plan.placed;
    placed.push_back({segment, heading_rad});
    if (auto longer = within_limits(std::move(placed))) return longer;
  }
  return std::nullopt;
}

Plan Planner::select() {
  auto begun = within_limits({});
  if (!begun) {
    const config::Mission shortest = compose({}, alphabet_, regime_).mission;
    const PlannedPath path = rehearser_.path(shortest, limits_.duration_s + 1);
    throw std::invalid_argument(fmt::format("the limits are too narrow for any mission; the shortest has {}",
                                            fmt::join(violations(extremes_of(path, limits_), limits_), "; ")));
  }
  Plan plan = std::move(*begun);
  Contribution sum = nothing(question_);
  std::vector<bool> refused(known_.size(), false);
  while (plan.placed.size() < kMostManoeuvres) {
    const double loss = question_.loss(sum);
    if (question_.purpose == MissionPurpose::separate && loss < kDecidedLog) break;
    std::size_t best = known_.size();
    double best_rate = 0;
    for (std::size_t i = 0; i < known_.size(); ++i) {
      if (refused[i]) continue;
      Contribution with = sum;
      with += known_[i].contribution;
      const double rate = (loss - question_.loss(with)) / known_[i].duration_s;
      if (rate > best_rate) {
        best = i;
        best_rate = rate;
      }
    }
    if (best == known_.size()) break;
    if (auto longer = extended(plan, known_[best].segment)) {
      plan = std::move(*longer);
      sum += known_[best].contribution;
      progress_("choosing manoeuvres", plan.path.duration_s / limits_.duration_s);
    } else {
      refused[best] = true;
    }
  }
  return plan;
}

RehearsedPlan Planner::rehearsed(Plan plan) const {
  RehearsedPlan result;
  const auto begins_s = part_begins(plan);
  const Rehearsal rehearsal = rehearser_.rehearse(plan.composed.mission, plan.path.duration_s, begins_s);
  result.all = {rehearsal.gram, coverage_of(plan.path, 0, plan.path.duration_s)};
  for (std::size_t i = 0; i < plan.placed.size(); ++i) {
    result.parts.push_back({rehearsal.parts[i], coverage_of(plan.path, begins_s[i], begins_s[i + 1])});
  }
  result.loss = question_.loss(result.all);
  result.plan = std::move(plan);
  return result;
}

std::optional<Plan> Planner::exchanged(const RehearsedPlan& from) const {
  std::vector<PlacedSegment> placed = from.plan.placed;
  std::vector<Contribution> parts = from.parts;
  Contribution sum = from.all;
  double loss = from.loss, spare_s = limits_.duration_s - from.plan.path.duration_s;
  const auto begins_s = part_begins(from.plan);
  std::vector<double> durations_s;
  for (std::size_t i = 0; i < placed.size(); ++i) durations_s.push_back(begins_s[i + 1] - begins_s[i]);
  int exchanges = 0;
  for (; exchanges < kExchangesPerRound; ++exchanges) {
    std::size_t out = 0;
    const Known* in = nullptr;
    double best = loss - 0.02;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      for (const Known& known : known_) {
        if (known.segment == placed[i].segment || known.duration_s > durations_s[i] + spare_s) continue;
        const Contribution tried{sum.gram - parts[i].gram + known.contribution.gram,
                                 sum.coverage - parts[i].coverage + known.contribution.coverage};
        if (const double by = question_.loss(tried); by < best) {
          best = by;
          out = i;
          in = &known;
        }
      }
    }
    if (in == nullptr) break;
    sum.gram += in->contribution.gram - parts[out].gram;
    sum.coverage += in->contribution.coverage - parts[out].coverage;
    spare_s += durations_s[out] - in->duration_s;
    durations_s[out] = in->duration_s;
    parts[out] = in->contribution;
    placed[out].segment = in->segment;
    loss = best;
  }
  if (exchanges == 0) return std::nullopt;
  return within_limits(std::move(placed));
}

RehearsedPlan Planner::plan() {
  Plan selected = select();
  progress_("simulating the mission", 0);
  RehearsedPlan best = rehearsed(std::move(selected));
  for (int round = 0; round < kExchangeRounds; ++round) {
    progress_("simulating the mission", (1.0 + round) / (1 + kExchangeRounds));
    auto other = exchanged(best);
    if (!other) break;
    RehearsedPlan tried = rehearsed(std::move(*other));
    if (!(tried.loss < best.loss)) break;
    best = std::move(tried);
  }
  return best;
}

}  // namespace navcal::gap
