// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "base/text_rows.h"
#include "report/thesis_content.h"

namespace navcal::report {

const char* column_rows();  // thesis_columns.txt: "key decimals: head"

namespace {

ThesisColumn column_of(const std::string& key) {
  for (const auto& [about, head] : base::text_rows(column_rows(), ": ")) {
    if (about.substr(0, about.size() - 2) == key) return {key, std::string(head), about.back() - '0'};
  }
  throw std::logic_error("no column " + key);
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

ThesisTablePart thesis_part(std::string key, std::string title, std::size_t rows,
                            const std::vector<ThesisColumnOf>& columns) {
  ThesisTablePart part{std::move(key), std::move(title), {}, {}};
  for (const auto& column : columns) part.columns.push_back(column_of(column.key));
  for (std::size_t row = 0; row < rows; ++row) {
    auto& cells = part.rows.emplace_back();
    for (const auto& column : columns) cells.push_back(column.get(row));
  }
  return part;
}

ThesisTablePart thesis_estimates(std::string key, std::string title, const std::vector<ThesisEstimate>& rows) {
  using Row = std::size_t;
  return thesis_part(
      std::move(key), std::move(title), rows.size(),
      {kThesisPathColumn,
       {"thesis", [&](Row i) { return rows[i].printed; }},
       {"thesis_percent", [&](Row i) { return rows[i].printed_percent; }},
       {"recomputed", [&](Row i) { return rows[i].recomputed; }},
       {"recomputed_percent", [&](Row i) { return percent(rows[i], rows[i].recomputed - rows[i].truth); }},
       {"navcal", [&](Row i) { return rows[i].navcal; }},
       {"navcal_percent", [&](Row i) { return percent(rows[i], rows[i].navcal - rows[i].truth); }},
       {"noise_method_percent", [&](Row i) { return size_percent(rows[i], rows[i].method_rms); }},
       {"noise_navcal_percent", [&](Row i) { return size_percent(rows[i], rows[i].navcal_rms); }},
       {"bound_percent", [&](Row i) { return size_percent(rows[i], rows[i].bound); }},
       {"thesis_bounds", [&](Row i) { return std::abs(rows[i].printed - rows[i].truth) / rows[i].bound; }},
       {"noise_method_bounds", [&](Row i) { return rows[i].method_rms / rows[i].bound; }},
       {"noise_navcal_bounds", [&](Row i) { return rows[i].navcal_rms / rows[i].bound; }}});
}

std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results) {
  std::vector<ThesisTable> tables = thesis_gyro_tables(results);
  tables.push_back(thesis_compass_table(results));
  for (auto& table : thesis_field_tables(results)) tables.push_back(std::move(table));
  for (ThesisTable& table : tables) table.words = thesis_caption("table-" + table.id);
  return tables;
}

}  // namespace navcal::report
