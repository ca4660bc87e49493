// SPDX-License-Identifier: Apache-2.0
#include "calib/field_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

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

}  // namespace navcal::calib
