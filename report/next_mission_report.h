// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gap/design/mission_design.h"

namespace navcal::report {

/// What navcal gap next planned: for people, as one JSON object (docs/gap.md), and as a page with pictures.
/// `file`: name of the mission file.
[[nodiscard]] std::string next_mission_text(const gap::NextMission& next, const std::string& file);
[[nodiscard]] std::string next_mission_json(const gap::NextMission& next, const std::string& file);
[[nodiscard]] std::string next_mission_page(const gap::NextMission& next, const std::string& file);

}  // namespace navcal::report
