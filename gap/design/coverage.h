// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gap/data/innovations.h"
#include "gap/design/planned_run.h"

namespace navcal::gap {

/// Time spent in each regime of the vehicle: bands of shaft speed, rate of turn, depth, pitch, roll, heading, and
/// time since the start (which the temperature of the electronics follows), and bands of rate of turn at each band
/// of shaft speed.
using Coverage = Eigen::VectorXd;  // seconds

[[nodiscard]] Coverage no_coverage();
[[nodiscard]] Coverage coverage_of(const Trajectory10Hz& course);
[[nodiscard]] Coverage coverage_of(const PlannedPath& path, double from_s, double until_s);

/// Loss that falls as unseen bands are visited: the sum of exp(-t / 5 s) over all bands.
[[nodiscard]] double coverage_loss(const Coverage& seconds);

/// Bands with less than 2 s before and at least 2 s after, in words: "depth 3 to 4 m".
[[nodiscard]] std::vector<std::string> newly_covered(const Coverage& before, const Coverage& after);

}  // namespace navcal::gap
