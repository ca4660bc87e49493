// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/svg_plot.h"

namespace navcal::report {

/// Axis of headings that is cut open at the least visited heading, so that a course about north does not jump from
/// the top to the bottom. Marks are N, NE, E and so on. Degrees.
class HeadingAxis {
 public:
  /// All headings to be shown.
  explicit HeadingAxis(const std::vector<double>& headings_deg);

  /// The heading within the axis.
  [[nodiscard]] double operator()(double heading_deg) const;
  [[nodiscard]] SvgPlot::Axis axis(std::string label) const;

 private:
  double least_deg_ = 0;
};

}  // namespace navcal::report
