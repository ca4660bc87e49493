// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

/// Matrix of counts as SVG within a page (svg_plot.h). A cell is as dark as its share of the row. It is blue if
/// row and column are of the same kind, else orange.
struct SvgMatrix {
  std::vector<std::string> rows, columns;
  std::vector<std::vector<int>> counts;     ///< by row
  std::vector<std::vector<bool>> agreeing;  ///< which cells are blue

  [[nodiscard]] std::string svg(std::string_view title) const;
};

}  // namespace navcal::report
