// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/causes/calibration_history.h"
#include "fleet/causes/fleet_answer.h"
#include "fleet/causes/pooled_missions.h"

namespace navcal::fleet {

/// All that is told of a fleet. References, valid as long as what they refer to.
struct FleetStory {
  const PooledMissions& missions;
  const FleetAnswer& answer;
  const std::vector<CalibrationHistory>& calibrations;
  const std::vector<std::string>& remarks;
};

/// The answer for people, as one JSON object with a line end (docs/fleet.md), and as a page.
[[nodiscard]] std::string fleet_text(const FleetStory& story);
[[nodiscard]] std::string fleet_json(const FleetStory& story);
[[nodiscard]] std::string fleet_page(const FleetStory& story);

/// "fin_gain of vehicle auv-3 since 2026-06-04 (a.cap)".
[[nodiscard]] std::string text_of(const PossibleCause& cause, const PooledMissions& missions);

/// "fin_gain 0.21 +- 0.02 of auv-3 since 2026-06-04 (v3-05.mcap), probability 0.98".
[[nodiscard]] std::string text_of(const FoundCause& cause, const PooledMissions& missions);

}  // namespace navcal::fleet
