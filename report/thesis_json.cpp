// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "report/thesis_content.h"
#include "report/thesis_page.h"

namespace navcal::report {
namespace {

using ThesisJson = nlohmann::ordered_json;

/// Seven digits: the figures have 100,000 numbers.
ThesisJson short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr);
}

ThesisJson cell_json(const ThesisCell& cell) {
  if (cell.number) return *cell.number;
  return cell.text.empty() ? ThesisJson(nullptr) : ThesisJson(cell.text);
}

ThesisJson table_json(const ThesisTable& table) {
  ThesisJson json{{"title", table.title}, {"parts", ThesisJson::object()}};
  for (const ThesisTablePart& part : table.parts) {
    ThesisJson rows = ThesisJson::array();
    for (const auto& cells : part.rows) {
      ThesisJson row = ThesisJson::object();
      for (std::size_t i = 0; i < cells.size(); ++i) row[part.columns[i].key] = cell_json(cells[i]);
      rows.push_back(std::move(row));
    }
    json["parts"][part.key] = std::move(rows);
  }
  return json;
}

ThesisJson curve_json(const ThesisCurve& curve) {
  ThesisJson json{{"name", curve.name}, {"x", ThesisJson::array()}, {"y", ThesisJson::array()}};
  for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
    json["x"].push_back(short_number(curve.x[i]));
    json["y"].push_back(short_number(curve.y[i]));
  }
  return json;
}

ThesisJson figure_json(const ThesisFigure& figure) {
  ThesisJson json{{"title", figure.title}, {"caption", figure.caption}, {"panels", ThesisJson::array()}};
  for (const ThesisPanel& panel : figure.panels) {
    ThesisJson curves = ThesisJson::array();
    for (const ThesisCurve& curve : panel.curves) curves.push_back(curve_json(curve));
    json["panels"].push_back(
        {{"title", panel.title}, {"x", panel.x_label}, {"y", panel.y_label}, {"curves", std::move(curves)}});
  }
  return json;
}

}  // namespace

std::string thesis_json(const analysis::ThesisResults& results) {
  const auto& perfect = results.perfect_error;
  ThesisJson json;
  json["class"] = "THESIS";
  json["runs"] = results.runs;
  json["seed"] = results.seed;
  json["metric_floor"] = {
      {"mean_deg", perfect.mean_deg}, {"largest_deg", perfect.largest_deg}, {"std_deg", perfect.std_deg}};
  json["tables"] = ThesisJson::object();
  for (const ThesisTable& table : thesis_tables(results)) json["tables"][table.id] = table_json(table);
  json["figures"] = ThesisJson::object();
  for (const ThesisFigure& figure : thesis_figures(results)) json["figures"][figure.id] = figure_json(figure);
  json["errata"] = ThesisJson::array();
  for (const auto& erratum : thesis_errata())
    json["errata"].push_back({{"place", erratum.at(0)}, {"what", erratum.at(1)}});
  return json.dump() + "\n";
}

}  // namespace navcal::report
