// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnose_layout.h"
#include "gap/design/next_mission.h"

namespace navcal::diagnosis {

/// Plans the mission within the limits that separates best what is still probable after a diagnosis. Throws
/// std::invalid_argument where no recording could be followed, the layout cannot be steered, or no mission fits
/// the limits.
[[nodiscard]] gap::NextMission plan_next_mission(const LayoutStudy& study, const config::MissionLimits& limits,
                                                 const gap::Progress& progress);

}  // namespace navcal::diagnosis
