// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gap/design/alphabet.h"
#include "gap/design/question.h"
#include "gap/design/rehearser.h"

namespace navcal::gap {

/// A composed mission that stays within the limits.
struct Plan {
  std::vector<PlacedSegment> placed;
  ComposedMission composed;
  PlannedPath path;
};

/// A plan with what the simulation of the whole mission says of it.
struct RehearsedPlan {
  Plan plan;
  Contribution all;
  std::vector<Contribution> parts;  ///< of each placed manoeuvre
  double loss = 0;
};

/// Composes missions of manoeuvres so that a loss becomes small.
///
/// Contributions of the manoeuvres are simulated once, one after the other in missions of their own, and add
/// approximately. Manoeuvres are taken greedily by the fall of the loss for each second. A longer mission begins
/// with the manoeuvres of a shorter one, so that it tells no less. Then single manoeuvres of the simulated mission
/// are exchanged (Fedorov 1972, exchange algorithm) as long as its simulation confirms the gain.
class Planner {
 public:
  /// Keeps references. Throws std::invalid_argument where no manoeuvre stays within the limits.
  Planner(const Question& question, const Rehearser& rehearser, const config::MissionLimits& limits,
          const Progress& progress);

  [[nodiscard]] RehearsedPlan plan();
  /// That plans are made of.
  [[nodiscard]] const std::vector<Segment>& segments() const { return alphabet_; }

 private:
  /// A manoeuvre of the alphabet, as it was simulated.
  struct Known {
    std::size_t segment = 0;
    double duration_s = 0;
    Contribution contribution;
  };
  void learn_alphabet();
  /// Those that the vehicle survives.
  void learn_halves(const std::vector<std::size_t>& segments);
  void learn(const std::vector<std::size_t>& segments);
  /// Greedy selection.
  [[nodiscard]] Plan select();
  /// The plan with one more manoeuvre, on a heading that keeps it within the limits; empty: none does.
  [[nodiscard]] std::optional<Plan> extended(const Plan& plan, std::size_t segment) const;
  [[nodiscard]] std::optional<Plan> within_limits(std::vector<PlacedSegment> placed) const;
  [[nodiscard]] RehearsedPlan rehearsed(Plan plan) const;
  /// The plan with its least useful manoeuvres exchanged, by the contributions; empty: no exchange is a gain.
  [[nodiscard]] std::optional<Plan> exchanged(const RehearsedPlan& from) const;

  const Question& question_;
  const Rehearser& rehearser_;
  const config::MissionLimits& limits_;
  const Progress& progress_;
  Regime regime_;
  std::vector<Segment> alphabet_;
  std::vector<Known> known_;
};

}  // namespace navcal::gap
