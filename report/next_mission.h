// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gap/design/next_mission.h"

namespace navcal::report {

/// Inputs of a plan.
struct NextMissionSource {
  std::vector<std::string> recordings;
  std::vector<std::string> holdouts;
  std::vector<std::string> nominals;  ///< of a layout
  std::string vehicle;                ///< empty: the reference vehicle
  std::string limits;                 ///< empty: the defaults
  std::string mission;                ///< the file that is written
};

/// The plan as one JSON object (docs/gap.md); `mission` is the name of its file.
[[nodiscard]] std::string next_mission_json(const gap::NextMission& next, const NextMissionSource& source);
/// The plan as text for a terminal.
[[nodiscard]] std::string next_mission_text(const gap::NextMission& next, const NextMissionSource& source);
/// Page with the path, depth and heading over time, and the separations as bars; needs no other file.
[[nodiscard]] std::string next_mission_page(const gap::NextMission& next, const NextMissionSource& source);
/// Comment lines at the head of the mission file.
[[nodiscard]] std::string next_mission_head(const gap::NextMission& next);

}  // namespace navcal::report
