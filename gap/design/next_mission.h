// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/mission.h"
#include "config/mission_limits.h"
#include "gap/design/planned_run.h"
#include "gap/verdict/study.h"

namespace navcal::gap {

/// Purpose of a planned mission, by the diagnosis so far.
enum class MissionPurpose : std::uint8_t {
  separate,  ///< several sets of effects, or none, are still probable
  cover,     ///< a foreign cause is suspected: regimes that the recordings have not seen
  sharpen,   ///< no gap so far: the effects that were tested least
};
/// "separate", "cover", "sharpen".
[[nodiscard]] std::string_view name_of(MissionPurpose purpose);

/// Two sets of effects that are still probable.
struct PlannedPair {
  std::vector<std::string> a, b;  ///< empty: no effect
  double separation_nats = 0;     ///< expected log Bayes factor for a over b if a is true
  double reverse_nats = 0;        ///< for b over a if b is true
};

/// Set of effects that is still probable.
struct PlannedSet {
  std::vector<std::string> effects;
  double probability = 0;
};

/// Smallest strength of one parameter that stands out, in typical values; empty: not shown.
struct DetectableStrength {
  std::string effect, parameter;
  std::optional<double> before, after;  ///< by the recordings, and by them and the planned mission
};

/// A set of effects in words: "fin_gain + gyro_scale", "no effect".
[[nodiscard]] std::string set_text(const std::vector<std::string>& effects);
/// "0.85", "not shown".
[[nodiscard]] std::string strength_text(const std::optional<double>& strength);

struct NextMission {
  MissionPurpose purpose = MissionPurpose::separate;
  config::Mission mission;
  PlannedPath path;  ///< of the nominal vehicle
  PathExtremes extremes;
  config::MissionLimits limits;
  bool decides = false;
  double probability_exact = 0;  ///< that the answer afterwards is the true set, if it is among `sets`
  double probability_now = 0;    ///< of the leading set
  std::vector<PlannedSet> sets;  ///< most probable first
  std::vector<PlannedPair> pairs;
  std::vector<DetectableStrength> strengths;  ///< one per effect: its weakest parameter
  std::vector<std::string> newly_covered;     ///< regimes that no recording has seen
  std::vector<std::string> manoeuvres;        ///< in order
  std::string sentence;
  std::vector<std::string> remarks;
  double seconds = 0;  ///< computing time of the plan, without the diagnosis

  [[nodiscard]] double minutes() const { return path.duration_s / 60; }
};

struct Question;
class Rehearser;

/// Plans the mission within the limits that answers a question best. Greedy selection of manoeuvres from an
/// alphabet by their Gram matrices, exchange of single manoeuvres, and a simulation of the whole mission, by which
/// all numbers are stated. Throws std::invalid_argument where no mission fits the limits.
[[nodiscard]] NextMission plan_next_mission(const Question& question, const Rehearser& rehearser,
                                            const config::MissionLimits& limits, const Progress& progress);

/// The mission that separates best what is still probable after a diagnosis. Throws std::invalid_argument where
/// the recording could not be diagnosed, or no mission fits the limits.
[[nodiscard]] NextMission plan_next_mission(const Study& study, const config::MissionLimits& limits,
                                            const Progress& progress);

}  // namespace navcal::gap
