// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using EstimateColumn = ThesisColumnOf<ThesisEstimate>;

ThesisCell number_cell(double value) {
  if (!std::isfinite(value)) return {};
  return {value, {}};
}

/// A column of any number of a row.
EstimateColumn column(const char* key, const char* head, int decimals, double (*get)(const ThesisEstimate&)) {
  return {{key, head, decimals}, [get](const ThesisEstimate& row) { return number_cell(get(row)); }};
}

double percent(const ThesisEstimate& row, double error) { return 100 * error / row.percent_of; }
double size_percent(const ThesisEstimate& row, double error) { return std::abs(percent(row, error)); }

}  // namespace

std::string shown_cell(const ThesisCell& cell, const ThesisColumn& column) {
  if (!cell.number) return cell.text.empty() ? "-" : cell.text;
  const std::string text = fmt::format("{:.{}f}", *cell.number, column.decimals);
  // No negative zero.
  const bool zero = text.find_first_of("123456789") == std::string::npos && text.front() == '-';
  return zero ? text.substr(1) : text;
}

ThesisTablePart thesis_estimates(std::string key, std::string title, const std::vector<ThesisEstimate>& rows,
                                 int decimals) {
  using Row = ThesisEstimate;
  const std::vector<EstimateColumn> columns{
      column("path", "path", 0, [](const Row& r) { return static_cast<double>(r.path); }),
      column("thesis", "thesis", decimals, [](const Row& r) { return r.printed; }),
      column("thesis_percent", "thesis, %", 2, [](const Row& r) { return r.printed_percent; }),
      column("recomputed", "recomputed", decimals, [](const Row& r) { return r.recomputed; }),
      column("recomputed_percent", "recomputed, %", 2,
             [](const Row& r) { return percent(r, r.recomputed - r.truth); }),
      column("navcal", "navcal", decimals, [](const Row& r) { return r.navcal; }),
      column("navcal_percent", "navcal, %", 4, [](const Row& r) { return percent(r, r.navcal - r.truth); }),
      column("noise_method_percent", "noise: method of the thesis, %", 2,
             [](const Row& r) { return size_percent(r, r.method_rms); }),
      column("noise_navcal_percent", "noise: navcal, %", 3,
             [](const Row& r) { return size_percent(r, r.navcal_rms); }),
      column("bound_percent", "bound, %", 3, [](const Row& r) { return size_percent(r, r.bound); }),
      column("thesis_bounds", "thesis / bound", 1,
             [](const Row& r) { return std::abs(r.printed - r.truth) / r.bound; }),
      column("noise_method_bounds", "method / bound", 1, [](const Row& r) { return r.method_rms / r.bound; }),
      column("noise_navcal_bounds", "navcal / bound", 2, [](const Row& r) { return r.navcal_rms / r.bound; }),
  };
  return thesis_part(std::move(key), std::move(title), rows, columns);
}

std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results) {
  std::vector<ThesisTable> tables = thesis_gyro_tables(results);
  tables.push_back(thesis_compass_table(results));
  for (auto& table : thesis_field_tables(results)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace navcal::report
