// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "analysis/thesis/thesis_results.h"
#include "report/thesis_content.h"

namespace navcal::report {

/// Tables 3.1, 3.2, "convergence", 4.1, 4.2 and "magnetometer-paths", in this order.
[[nodiscard]] std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results);

[[nodiscard]] std::vector<ThesisTable> thesis_gyro_tables(const analysis::ThesisResults& results);
[[nodiscard]] ThesisTable thesis_compass_table(const analysis::ThesisResults& results);
[[nodiscard]] std::vector<ThesisTable> thesis_field_tables(const analysis::ThesisResults& results);

/// A column with the way to its number in a row.
template <class Row>
struct ThesisColumnOf {
  ThesisColumn column;
  std::function<ThesisCell(const Row&)> get;
};

template <class Row>
ThesisTablePart thesis_part(std::string key, std::string title, const std::vector<Row>& rows,
                            const std::vector<ThesisColumnOf<Row>>& columns) {
  ThesisTablePart part{std::move(key), std::move(title), {}, {}};
  for (const auto& column : columns) part.columns.push_back(column.column);
  for (const Row& row : rows) {
    auto& cells = part.rows.emplace_back();
    for (const auto& column : columns) cells.push_back(column.get(row));
  }
  return part;
}

/// Estimates of one coefficient on one path, in its own unit.
struct ThesisEstimate {
  int path = 0;
  double truth = 0;
  double printed = 0, printed_percent = 0;
  double recomputed = 0;                  ///< by the method of the thesis, no noise
  double navcal = 0;                      ///< no noise
  double method_rms = 0, navcal_rms = 0;  ///< with noise
  double bound = 0;
  double percent_of = 1;  ///< what errors are percentages of: the true value or its amount
};
/// The columns that tables 3.1, 3.2 and 4.1 have in common.
[[nodiscard]] ThesisTablePart thesis_estimates(std::string key, std::string title,
                                               const std::vector<ThesisEstimate>& rows, int decimals);

}  // namespace navcal::report
