// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/data/innovations.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// Places over time: north and east in metres of the mission's first fix.
struct Track {
  std::vector<double> time_s, north_m, east_m;
};

/// What was measured, and where the model would have gone from the first fix on without ever being corrected by
/// another: its speed through the water by the recorded shaft, its heading by its own view of compass and gyros. A
/// current moves the fixes and not these.
struct Tracks {
  Track fixes, nominal, improved;  ///< improved: with the effects found; empty without any
};

[[nodiscard]] Track track_of_fixes(const Mission& mission);
/// Dead reckoning along a replay's course from the mission's first fix on; empty without a fix.
[[nodiscard]] Track reckoned_track(const Trajectory10Hz& course, const Mission& mission);

}  // namespace navcal::gap
