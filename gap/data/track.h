// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gap/data/innovations.h"
#include "gap/data/mission.h"

namespace navcal::gap {

/// Positions over time: north and east in metres of the mission's first fix.
struct Track {
  std::vector<double> time_s, north_m, east_m;
};

/// Measured fixes, and the positions that the model reckons from the first fix on without any later correction.
/// Speed through the water follows from the recorded shaft speed, heading from the model's own estimate by
/// compass and gyros. A water current moves the fixes and not the reckoned tracks.
struct Tracks {
  Track fixes, nominal, improved;  ///< improved: with the effects found; empty without any
};

[[nodiscard]] Track track_of_fixes(const Mission& mission);
/// Dead reckoning along a replay's course from the mission's first fix on; empty without a fix.
[[nodiscard]] Track reckoned_track(const Trajectory10Hz& course, const Mission& mission);

}  // namespace navcal::gap
