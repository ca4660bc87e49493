// SPDX-License-Identifier: Apache-2.0
#include "calib/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "base/angles.h"

namespace navcal::calib {

FieldCoverage::FieldCoverage(std::vector<double> headings_rad) {
  std::erase_if(headings_rad, [](double heading) { return !std::isfinite(heading); });
  if (headings_rad.empty()) return;
  for (double& heading : headings_rad) heading = base::positive_angle(heading);
  std::sort(headings_rad.begin(), headings_rad.end());
  double gap = headings_rad.front() + base::kTurn_rad - headings_rad.back();
  gap_begin_rad_ = headings_rad.back();
  for (std::size_t i = 1; i < headings_rad.size(); ++i) {
    if (headings_rad[i] - headings_rad[i - 1] <= gap) continue;
    gap = headings_rad[i] - headings_rad[i - 1];
    gap_begin_rad_ = headings_rad[i - 1];
  }
  arc_rad_ = std::max(0.0, base::kTurn_rad - gap);  // a single heading: the gap is a turn, or rounded beyond it
}

std::string FieldCoverage::manoeuvre(double wanted_rad) const {
  const double more = std::clamp(wanted_rad - arc_rad_, 0.0, base::kTurn_rad - arc_rad_);
  return "turn through " + whole_degrees(more) + " more degrees, headings " + whole_degrees(gap_begin_rad_) +
         " to " + whole_degrees(base::positive_angle(gap_begin_rad_ + more));
}

std::string rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::clamp(value, -1e9, 1e9));
  return text;
}

std::string whole_degrees(double angle_rad) { return rounded(angle_rad * (180 / std::numbers::pi), 0); }

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
