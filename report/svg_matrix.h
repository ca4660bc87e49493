// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

/// Counts of one thing against another as SVG that stands within a page (svg_plot.h). A cell is as dark as its
/// share of the row; where row and column are the same in kind it is blue, else orange.
struct SvgMatrix {
  std::vector<std::string> rows, columns;
  std::vector<std::vector<int>> counts;     ///< by row
  std::vector<std::vector<bool>> agreeing;  ///< which cells are blue

  [[nodiscard]] std::string svg(std::string_view title) const;
};

}  // namespace navcal::report
