// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "calib/judgement.h"

namespace navcal::calib {

inline constexpr double kSector_deg = 10;

/// Sector of a heading in a Rose.
[[nodiscard]] std::size_t sector_of(double heading_rad);

/// Sectors that were visited.
[[nodiscard]] std::size_t visited(const HeadingHistogram& rose);

/// The longest stretch of headings not visited: "turn through 140 more degrees, headings 200 to 340". Empty when
/// there is none.
[[nodiscard]] std::string missing_turn(const HeadingHistogram& rose);

}  // namespace navcal::calib
