// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/mission_limits.h"
#include "gap/design/planned_mission.h"
#include "gap/verdict/diagnosis.h"
#include "gap/verdict/request.h"

namespace navcal::gap {

/// Two sets of effects that could be true, and the log evidence that the planned mission is expected to add
/// between them.
struct SeparatedPair {
  std::vector<std::string> a, b;  ///< empty: no effect
  double separation_nats = 0;     ///< the smaller of both: if a is true, and if b is
  double so_far_nats = 0;         ///< log odds of a against b by the recordings
};

/// A manoeuvre of the planned mission.
struct ChosenManoeuvre {
  std::string name;
  double from_s = 0;
};

/// What the next mission is for.
enum class DesignPurpose : std::uint8_t {
  separate,  ///< to tell what is still probable apart
  cover,     ///< a foreign cause is suspected: to sail what was not sailed yet
  test,      ///< no gap so far: to show weak effects that the recordings would not have shown
};
/// "separate", "cover", "test".
[[nodiscard]] std::string_view name_of(DesignPurpose purpose);

/// The mission that is to be sailed next, and what it is expected to decide.
struct NextMission {
  Diagnosis diagnosis;  ///< of the recordings so far
  DesignPurpose purpose = DesignPurpose::separate;
  std::string toml;  ///< the mission file; empty: the recordings cannot be diagnosed
  double duration_s = 0;
  bool decides = false;              ///< some pair becomes decided that is not
  double probability_exact = 0;      ///< of an exact answer after the mission
  double probability_so_far = 0;     ///< the same without it
  std::vector<SeparatedPair> pairs;  ///< least separated first
  std::vector<ChosenManoeuvre> manoeuvres;
  std::vector<PlannedInstant> track;
  std::vector<std::string> covers;  ///< what it sails that the recordings did not
  std::string sentence;
  double energy_J = 0;
  double seconds = 0;  ///< computing time of the planning
};

/// Diagnoses the recordings, and designs the mission within the limits that is expected to tell most of what is
/// still probable (Bayesian experimental design: Chaloner and Verdinelli 1995; T-optimality between models:
/// Atkinson and Fedorov 1975). Throws as diagnose() does.
[[nodiscard]] NextMission next_mission(const Request& request, const config::MissionLimits& limits,
                                       const Progress& progress);

}  // namespace navcal::gap
