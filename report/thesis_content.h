// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/thesis/thesis_results.h"
#include "report/svg_plot.h"

/// Tables and figures of `navcal thesis` before they become a page or JSON, so that both show the same.
namespace navcal::report {

struct ThesisColumn {
  std::string key;   ///< in JSON
  std::string head;  ///< on the page
  int decimals = 0;  ///< of a number on the page
};

/// A number, a text, or nothing.
struct ThesisCell {
  ThesisCell() = default;
  ThesisCell(double value) : number(std::isfinite(value) ? std::optional(value) : std::nullopt) {}
  ThesisCell(std::string words) : text(std::move(words)) {}

  std::optional<double> number{};
  std::string text{};
};

struct ThesisTablePart {
  std::string key, title;
  std::vector<ThesisColumn> columns;
  std::vector<std::vector<ThesisCell>> rows;  ///< as many cells as columns
};

struct ThesisTable {
  std::string id;  ///< "3.1"; other names for tables that the thesis does not have
  std::string title;
  std::vector<ThesisTablePart> parts;
  std::string words = {};  ///< how to read it: thesis_tables() takes it from thesis_captions.txt
};

/// A figure of the thesis that shows a path.
struct PathFigure {
  const char* id;
  int path;
  bool noisy = false;
};

struct ThesisCurve {
  std::string name;
  SvgPlot::Ink ink = SvgPlot::Ink::first;
  std::vector<double> x, y;  ///< x may be longer than y
  bool dots = false;
};

struct ThesisPanel {
  std::string title, x_label, y_label;
  std::vector<ThesisCurve> curves;
  bool equal_axes = false;
  std::optional<Range> y_range{};  ///< nothing: all of every curve
};

/// A figure of the thesis.
struct ThesisFigure {
  std::string id;  ///< "3.1"
  std::string title;
  std::vector<ThesisPanel> panels;
  std::string caption = {};  ///< empty: that of thesis_captions.txt
};

/// The caption of a figure or a table in thesis_captions.txt; empty where there is none.
[[nodiscard]] std::string thesis_caption(const std::string& id);

/// Cell as on the page.
[[nodiscard]] std::string shown_cell(const ThesisCell& cell, const ThesisColumn& column);

/// Figures 1.1, 1.2, 2.3 to 2.6, 3.1 to 3.11 and 4.1 to 4.12, in this order.
[[nodiscard]] std::vector<ThesisFigure> thesis_figures(const analysis::ThesisResults& results);

/// Figures 1.1, 1.2, 2.3 to 2.6.
[[nodiscard]] std::vector<ThesisFigure> thesis_model_figures(const analysis::ThesisResults& results);
/// Figure 4.1: the error of the simulated compass. Figure 4.7: that of figure 2.5, and its sinusoid.
[[nodiscard]] ThesisFigure thesis_deviation_figure();
[[nodiscard]] ThesisFigure thesis_hard_iron_figure();
/// Figures 3.1 to 3.11.
[[nodiscard]] std::vector<ThesisFigure> thesis_turn_figures(const analysis::ThesisResults& results);
/// Figures 4.1 to 4.6.
[[nodiscard]] std::vector<ThesisFigure> thesis_compass_figures(const analysis::ThesisResults& results);
/// Figures 4.7 to 4.12.
[[nodiscard]] std::vector<ThesisFigure> thesis_field_figures(const analysis::ThesisResults& results);

/// The trace of a path, with noise or without. Throws std::logic_error where there is none.
template <class Trace>
const Trace& thesis_trace_of(const std::vector<Trace>& traces, int path, bool noisy) {
  for (const Trace& trace : traces) {
    if (trace.path == path && trace.noisy == noisy) return trace;
  }
  throw std::logic_error("no trace of this path");
}

/// Panel of the track, a metre north as long as a metre east.
template <class Trace>
ThesisPanel thesis_track_panel(const Trace& trace) {
  return {"Track", "east, m", "north, m", {{"", SvgPlot::Ink::first, trace.east_m, trace.north_m}}, true};
}

/// Tables 3.1, 3.2, "convergence", 4.1, 4.2 and "magnetometer-paths", in this order.
[[nodiscard]] std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results);

[[nodiscard]] std::vector<ThesisTable> thesis_gyro_tables(const analysis::ThesisResults& results);
[[nodiscard]] ThesisTable thesis_compass_table(const analysis::ThesisResults& results);
[[nodiscard]] std::vector<ThesisTable> thesis_field_tables(const analysis::ThesisResults& results);

/// A column with the way to its cell in a row.
struct ThesisColumnOf {
  std::string key;  ///< in thesis_columns.txt
  std::function<ThesisCell(std::size_t row)> get;
};
/// Numbers of the paths.
inline const ThesisColumnOf kThesisPathColumn{"path",
                                              [](std::size_t row) { return static_cast<double>(row) + 1; }};

[[nodiscard]] ThesisTablePart thesis_part(std::string key, std::string title, std::size_t rows,
                                          const std::vector<ThesisColumnOf>& columns);

/// Estimates of one coefficient on one path, in its own unit.
struct ThesisEstimate {
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
                                               const std::vector<ThesisEstimate>& rows);

/// A sentence on each table.
struct ThesisFinding {
  std::string word, sentence;
};
[[nodiscard]] std::vector<ThesisFinding> thesis_findings(const analysis::ThesisResults& results);

/// Errors and disagreements within the thesis, as (place, what is the matter).
[[nodiscard]] std::vector<std::vector<std::string>> thesis_errata();

}  // namespace navcal::report
