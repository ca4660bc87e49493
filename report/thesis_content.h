// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
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

/// Tables 3.1, 3.2, "convergence", 4.1, 4.2 and "magnetometer-paths", in this order.
[[nodiscard]] std::vector<ThesisTable> thesis_tables(const analysis::ThesisResults& results);

/// A sentence on each table.
struct ThesisFinding {
  std::string word, sentence;
};
[[nodiscard]] std::vector<ThesisFinding> thesis_findings(const analysis::ThesisResults& results);

/// Errors and disagreements within the thesis, as (place, what is the matter).
[[nodiscard]] std::vector<std::vector<std::string>> thesis_errata();

}  // namespace navcal::report
