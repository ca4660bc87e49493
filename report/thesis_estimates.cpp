// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "report/thesis_content.h"

namespace navcal::report {
namespace {

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

ThesisTablePart thesis_part(std::string key, std::string title, std::size_t rows,
                            const std::vector<ThesisColumnOf>& columns) {
  ThesisTablePart part{std::move(key), std::move(title), {}, {}};
  for (const auto& column : columns) part.columns.push_back(column.column);
  for (std::size_t row = 0; row < rows; ++row) {
    auto& cells = part.rows.emplace_back();
    for (const auto& column : columns) cells.push_back(column.get(row));
  }
  return part;
}

ThesisTablePart thesis_estimates(std::string key, std::string title, const std::vector<ThesisEstimate>& rows,
                                 int decimals) {
  const auto column = [&](const char* name, const char* head, int shown,
                          double (*get)(const ThesisEstimate&)) -> ThesisColumnOf {
    return {{name, head, shown}, [&rows, get](std::size_t i) { return get(rows[i]); }};
  };
  using Row = ThesisEstimate;
  return thesis_part(
      std::move(key), std::move(title), rows.size(),
      {kThesisPathColumn, column("thesis", "thesis", decimals, [](const Row& r) { return r.printed; }),
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
       column("noise_navcal_bounds", "navcal / bound", 2, [](const Row& r) { return r.navcal_rms / r.bound; })});
}

std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results) {
  std::vector<ThesisTable> tables = thesis_gyro_tables(results);
  tables.push_back(thesis_compass_table(results));
  for (auto& table : thesis_field_tables(results)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace navcal::report
