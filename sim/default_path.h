// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/path.h"

namespace navcal::sim {

/// Two and a half minutes at 1 m/s that end where they began: straight legs, circles and turns to both sides, and
/// a stretch at 1.15 m depth, out of reach of GPS.
[[nodiscard]] std::vector<PathRow> default_path();

}  // namespace navcal::sim
