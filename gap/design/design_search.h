// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "config/mission_limits.h"
#include "gap/design/hypotheses.h"
#include "gap/design/manoeuvres.h"
#include "gap/design/mission_design.h"

namespace navcal::gap {

/// What a mission is designed for. References; valid as long as what they refer to.
struct DesignGoal {
  DesignPurpose purpose = DesignPurpose::separate;
  const std::vector<Hypothesis>& hypotheses;
  Eigen::MatrixXd information;  ///< of the recordings so far, without the biases
  const Library& library;
  const Priors& priors;
  std::set<std::string> sailed;  ///< regimes of the recordings so far
};

/// Expected log evidence of hypothesis a (row) over b (column) if a is true, nats.
struct SeparationTable {
  Eigen::MatrixXd so_far;  ///< by the recordings
  Eigen::MatrixXd added;   ///< by the planned mission, beyond that
};
[[nodiscard]] SeparationTable separations(const DesignGoal& goal, const Eigen::MatrixXd& planned_information);

/// A mission within the limits, simulated as a whole.
struct DesignedMission {
  std::string toml;
  PlannedMission planned;
  double duration_s = 0;
  std::vector<ChosenManoeuvre> manoeuvres;
  Eigen::MatrixXd information;  ///< of the planned mission, without the biases
};

/// Chooses manoeuvres one after the other, each that adds most per second, then exchanges them while that helps.
/// The information of manoeuvres is added up for the choice. The mission that is chosen is simulated as a whole,
/// so the numbers that are told belong to it.
class DesignSearch {
 public:
  /// Keeps references.
  DesignSearch(const DiagnosisProblem& problem, const DesignGoal& goal, const config::MissionLimits& limits);

  [[nodiscard]] DesignedMission run();

 private:
  /// A manoeuvre of the alphabet, simulated alone.
  struct Simulated {
    ManoeuvreChoice choice;
    Eigen::MatrixXd gram;  ///< of all unknowns
    double seconds = 0;
    std::set<std::string> regimes;
  };
  using Chosen = std::vector<std::size_t>;

  void simulate_alphabet();
  [[nodiscard]] double utility(const Chosen& chosen) const;
  [[nodiscard]] double seconds_of(const Chosen& chosen) const;
  [[nodiscard]] Chosen chosen_greedily() const;
  void exchange(Chosen& chosen) const;
  [[nodiscard]] DesignedMission simulated(const Chosen& chosen) const;
  [[nodiscard]] Eigen::MatrixXd gram_of(const PlannedMission& planned, unsigned threads) const;
  [[nodiscard]] bool is_within_limits(const std::vector<PlannedInstant>& track, bool is_whole) const;

  const DiagnosisProblem& problem_;
  const DesignGoal& goal_;
  const config::MissionLimits& limits_;
  std::vector<Simulated> alphabet_;
};

}  // namespace navcal::gap
