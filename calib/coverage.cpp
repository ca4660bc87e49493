// SPDX-License-Identifier: Apache-2.0
#include "calib/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "calib/field_coverage.h"

namespace navcal::calib {

std::size_t sector_of(double heading_rad) {
  const double turns = heading_rad / (2 * std::numbers::pi);
  const double place = (turns - std::floor(turns)) * static_cast<double>(HeadingHistogram{}.size());
  return std::min(static_cast<std::size_t>(place), HeadingHistogram{}.size() - 1);
}

std::size_t visited(const HeadingHistogram& rose) {
  return static_cast<std::size_t>(std::count_if(rose.begin(), rose.end(), [](auto count) { return count > 0; }));
}

std::string missing_turn(const HeadingHistogram& rose) {
  if (visited(rose) == 0) return "turn through 360 degrees";
  if (visited(rose) == rose.size()) return {};
  std::vector<double> headings_rad;  // both ends and the middle of each sector visited
  for (std::size_t i = 0; i < rose.size(); ++i) {
    for (const double part : {0.0, 0.5, 1.0}) {
      if (rose[i] > 0)
        headings_rad.push_back((static_cast<double>(i) + part) * kSector_deg * base::kRadiansPerDegree);
    }
  }
  return FieldCoverage(std::move(headings_rad)).manoeuvre(base::kTurn_rad);
}

}  // namespace navcal::calib
