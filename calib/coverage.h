// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calib/judgement.h"

namespace navcal::calib {

/// Headings at which there are readings, and the largest gap between them.
class FieldCoverage {
 public:
  /// `headings_rad`: those of cells or groups of readings; any order, any turn.
  explicit FieldCoverage(std::vector<double> headings_rad);

  /// Arc of headings seen: the circle less its largest gap.
  [[nodiscard]] double arc_rad() const { return arc_rad_; }
  /// "turn through 140 more degrees, headings 200 to 340" so that the arc becomes `wanted_rad`.
  [[nodiscard]] std::string manoeuvre(double wanted_rad) const;

 private:
  double arc_rad_ = 0;
  double gap_begin_rad_ = 0;
};

/// "3.4" of 3.42: numbers in sentences for people.
[[nodiscard]] std::string rounded(double value, int decimals);
[[nodiscard]] std::string whole_degrees(double angle_rad);

inline constexpr double kSector_deg = 10;

/// Sector of a heading in a Rose.
[[nodiscard]] std::size_t sector_of(double heading_rad);

/// Sectors that were visited.
[[nodiscard]] std::size_t visited(const HeadingHistogram& rose);

/// The longest stretch of headings not visited: "turn through 140 more degrees, headings 200 to 340". Empty when
/// there is none.
[[nodiscard]] std::string missing_turn(const HeadingHistogram& rose);

}  // namespace navcal::calib
