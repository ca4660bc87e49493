// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

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
  std::string words;  ///< how to read it
  std::vector<ThesisTablePart> parts;
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

/// A figure of the thesis; without panels it is a picture that shows no data.
struct ThesisFigure {
  std::string id;  ///< "3.1"
  std::string title, caption;
  std::vector<ThesisPanel> panels;
};

/// Cell as on the page.
[[nodiscard]] std::string shown_cell(const ThesisCell& cell, const ThesisColumn& column);

}  // namespace navcal::report
