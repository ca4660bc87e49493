// SPDX-License-Identifier: Apache-2.0
#include "report/thesis_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/text_rows.h"
#include "report/html_page.h"
#include "report/thesis_content.h"

namespace navcal::report {

const char* reading_rows();  // thesis_reading.txt

namespace {

/// Three pictures side by side, or one or two.
constexpr SvgPlot::Size kThird{380, 260}, kHalf{540, 310};
constexpr std::size_t kMostPoints = 320;  // of a curve; the picture has no more pixels

bool in_chapter(const std::string& id, char chapter) { return id.size() > 1 && id[0] == chapter && id[1] == '.'; }

std::string table_id(const ThesisTable& table) { return "table-" + table.id; }
std::string figure_id(const ThesisFigure& figure) { return "figure-" + figure.id; }

std::vector<Point> points_of(const ThesisCurve& curve) {
  const std::size_t count = std::min(curve.x.size(), curve.y.size());
  const std::size_t step = count / (kMostPoints + 1) + 1;
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; i += step) points.push_back({curve.x[i], curve.y[i]});
  if (count > 0 && (count - 1) % step != 0) points.push_back({curve.x[count - 1], curve.y[count - 1]});
  return points;
}

Range range_over(const ThesisPanel& panel, std::vector<double> ThesisCurve::*axis) {
  std::vector<double> values;
  for (const ThesisCurve& curve : panel.curves) {
    const std::size_t count = std::min(curve.x.size(), curve.y.size());
    const auto& all = curve.*axis;
    values.insert(values.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return whole_range_of(values);
}

std::string panel_svg(const ThesisPanel& panel, SvgPlot::Size size) {
  Range x = range_over(panel, &ThesisCurve::x);
  Range y = panel.y_range.value_or(range_over(panel, &ThesisCurve::y));
  // Rounding errors of computing are no curve.
  if (y.length() < 1e-9) y = {-1, 1};
  if (panel.equal_axes) {
    // The frame is wider than high; a metre is as long on both axes.
    const double width = size.width - SvgPlot::kLeft - SvgPlot::kRight;
    const double height = size.height - SvgPlot::kTop - SvgPlot::kBottom;
    const double unit = std::max(x.length() / width, y.length() / height);
    const double x_middle = (x.least + x.most) / 2, y_middle = (y.least + y.most) / 2;
    x = {x_middle - unit * width / 2, x_middle + unit * width / 2};
    y = {y_middle - unit * height / 2, y_middle + unit * height / 2};
  }
  SvgPlot plot(panel.title, {panel.x_label, x}, {panel.y_label, y}, size);
  for (const ThesisCurve& curve : panel.curves) {
    if (curve.dots)
      plot.points(curve.ink, curve.name, points_of(curve));
    else
      plot.line(curve.ink, curve.name, points_of(curve));
  }
  return plot.svg();
}

Figure page_figure(const ThesisFigure& figure) {
  const bool thirds = figure.panels.size() % 3 == 0;
  std::string html = thirds ? "<div class=\"panels\">\n" : "<div class=\"panels pair\">\n";
  char letter = 'a';
  for (const ThesisPanel& panel : figure.panels)
    html += fmt::format("<div><h4>({}) {}</h4>\n{}</div>\n", letter++, escaped(panel.title),
                        panel_svg(panel, thirds ? kThird : kHalf));
  html += "</div>\n";
  return {"Figure " + figure.id + ": " + figure.title, html, figure.caption, figure_id(figure)};
}

void add_table(HtmlPage& page, const ThesisTable& table) {
  const bool numbered = in_chapter(table.id, '3') || in_chapter(table.id, '4');
  page.heading((numbered ? "Table " + table.id + ": " : "") + table.title, table_id(table));
  page.paragraph(table.words);
  for (const ThesisTablePart& part : table.parts) {
    if (!part.title.empty()) page.paragraph(part.title + ":");
    std::vector<std::string> heads;
    for (const ThesisColumn& column : part.columns) heads.push_back(column.head);
    std::vector<std::vector<std::string>> rows;
    for (const auto& cells : part.rows) {
      auto& row = rows.emplace_back();
      for (std::size_t i = 0; i < cells.size(); ++i) row.push_back(shown_cell(cells[i], part.columns[i]));
    }
    page.table(heads, rows);
  }
}

void add_index(HtmlPage& page, const std::vector<ThesisTable>& tables, const std::vector<ThesisFigure>& figures) {
  std::vector<HtmlPage::Link> links;
  for (const ThesisTable& table : tables) links.push_back({table_id(table), table.id});
  page.index("Tables", links);
  links.clear();
  for (const ThesisFigure& figure : figures) links.push_back({figure_id(figure), figure.id});
  page.index("Figures", links);
}

void add_figures(HtmlPage& page, const std::vector<ThesisFigure>& figures, char chapter) {
  std::vector<Figure> shown;
  for (const ThesisFigure& figure : figures) {
    if (in_chapter(figure.id, chapter)) shown.push_back(page_figure(figure));
  }
  page.wide_figures(shown);
}

void add_reading_help(HtmlPage& page, const analysis::ThesisResults& results) {
  page.section("How to read the tables");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [column, meaning] : base::text_rows(reading_rows(), ": "))
    rows.push_back({std::string(column), fmt::format(fmt::runtime(meaning), results.runs)});
  page.table({"column", "meaning"}, rows);
}

}  // namespace

std::string thesis_page(const analysis::ThesisResults& results) {
  const std::vector<ThesisTable> tables = thesis_tables(results);
  const std::vector<ThesisFigure> figures = thesis_figures(results);
  HtmlPage page("The thesis of 2003, recomputed");
  page.paragraph(
      "J. J. Mach's thesis (Virginia Tech, July 2003) calibrates the gyro and the compass of a small underwater "
      "vehicle. This page recomputes its tables and figures, and compares them with navcal and with the best that "
      "the readings allow.");
  for (const auto& finding : thesis_findings(results)) page.fact("plain", finding.word, finding.sentence);
  add_index(page, tables, figures);
  add_reading_help(page, results);
  page.section("Chapter 1: introduction");
  add_figures(page, figures, '1');
  page.section("Chapter 2: compass and gyro");
  add_figures(page, figures, '2');
  page.section("Chapter 3: rate gyro");
  for (const ThesisTable& table : tables) {
    if (in_chapter(table.id, '3') || table.id == "convergence") add_table(page, table);
  }
  add_figures(page, figures, '3');
  page.section("Chapter 4: compass");
  for (const ThesisTable& table : tables) {
    if (in_chapter(table.id, '4') || table.id == "magnetometer-paths") add_table(page, table);
  }
  add_figures(page, figures, '4');
  page.section("Errors of the thesis");
  page.table({"place", "what is the matter"}, thesis_errata());
  page.section("Made from");
  page.table({"", ""}, {{"Program", "navcal " NAVCAL_VERSION},
                        {"Runs with noise", fmt::format("{}", results.runs)},
                        {"Seed", fmt::format("{}", results.seed)}});
  return std::move(page).finish();
}

}  // namespace navcal::report
