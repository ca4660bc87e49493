// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/thesis/thesis_results.h"
#include "report/html_page.h"
#include "report/thesis_content.h"
#include "report/thesis_page.h"
#include "tests/report/markup.h"

namespace navcal::report {
namespace {

const analysis::ThesisResults& thesis_sample() {
  static const analysis::ThesisResults results =
      analysis::thesis_results({NAVCAL_SOURCE_DIR "/fixtures/paths", 2, 1}, [](std::string_view, double) {});
  return results;
}

const std::string& sample_page() {
  static const std::string page = thesis_page(thesis_sample());
  return page;
}

const nlohmann::json& sample_json() {
  static const nlohmann::json json = nlohmann::json::parse(thesis_json(thesis_sample()));
  return json;
}

std::vector<std::string> every_figure() {
  std::vector<std::string> ids{"1.1", "1.2"};
  for (int i = 3; i <= 6; ++i) ids.push_back("2." + std::to_string(i));
  for (int i = 1; i <= 11; ++i) ids.push_back("3." + std::to_string(i));
  for (int i = 1; i <= 12; ++i) ids.push_back("4." + std::to_string(i));
  return ids;
}

TEST(ThesisReport, ThePageIsWellFormed) { EXPECT_EQ(cli::test::flaw_in(sample_page()), ""); }

TEST(ThesisReport, PageAndJsonHaveEveryTableAndFigure) {
  for (const std::string table : {"3.1", "3.2", "4.1", "4.2"}) {
    EXPECT_NE(sample_page().find("Table " + table + ": "), std::string::npos) << table;
    EXPECT_TRUE(sample_json()["tables"].contains(table)) << table;
  }
  std::set<std::string> in_json;
  for (const auto& [id, figure] : sample_json()["figures"].items()) in_json.insert(id);
  const auto wanted = every_figure();
  EXPECT_EQ(in_json, std::set<std::string>(wanted.begin(), wanted.end()));
  for (const std::string& figure : wanted)
    EXPECT_EQ(cli::test::count(sample_page(), "<h3>Figure " + figure + ": "), 1) << figure;
}

TEST(ThesisReport, EveryLinkOfTheIndexLeadsSomewhere) {
  int links = 0;
  const std::string& page = sample_page();
  for (auto at = page.find("href=\"#"); at != std::string::npos; at = page.find("href=\"#", at + 1)) {
    const auto begin = at + 7;
    const std::string id = page.substr(begin, page.find('"', begin) - begin);
    EXPECT_EQ(cli::test::count(page, " id=\"" + id + "\""), 1) << id;
    ++links;
  }
  EXPECT_EQ(links, 6 + 29);
  EXPECT_EQ(page.find("http"), std::string::npos) << "a page needs nothing from elsewhere";
}

TEST(ThesisReport, EveryFigureHasCurves) {
  for (const auto& [id, figure] : sample_json()["figures"].items()) {
    EXPECT_FALSE(figure["panels"].empty()) << id;
    EXPECT_FALSE(figure["caption"].get<std::string>().empty()) << id;
    for (const auto& panel : figure["panels"]) {
      for (const auto& curve : panel["curves"]) {
        EXPECT_FALSE(curve["x"].empty()) << id << panel["title"];
        EXPECT_EQ(curve["x"].size(), curve["y"].size()) << id << panel["title"];
      }
    }
  }
}

/// A curve of a figure, (x, y).
std::vector<std::pair<double, double>> curve_of(const std::string& figure, std::size_t panel, std::size_t curve) {
  const auto& json = sample_json()["figures"][figure]["panels"][panel]["curves"][curve];
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < json["x"].size(); ++i) points.emplace_back(json["x"][i], json["y"][i]);
  return points;
}
constexpr double kDegree = std::numbers::pi / 180;

TEST(ThesisReport, FirstFixesFillTheBinsOfTheThesis) {
  for (const auto& [figure, longest_s] : {std::pair("1.1", 14), std::pair("1.2", 29)}) {
    double surfacings = 0, last_s = 0;
    for (const auto& [time_s, count] : curve_of(figure, 0, 0)) {
      if (time_s == std::floor(time_s)) ADD_FAILURE() << "the edges of a bar lie between full seconds";
      surfacings += count / 2;  // each bar has two upper corners
      if (count > 0) last_s = std::max(last_s, time_s);
      if (count > 0) {
        EXPECT_GT(time_s, 0.4) << figure;
      }
    }
    EXPECT_EQ(surfacings, 30) << figure;
    EXPECT_LE(last_s, longest_s + 0.5) << figure;
    EXPECT_GT(last_s, longest_s * 0.8) << figure;
  }
}

// Equation (2.7) with the thesis's A to E, by table 4.1's rule; its axis is on record.
TEST(ThesisReport, TheErrorOfTheCompassIsThatOfAToE) {
  const auto curve = curve_of("4.1", 0, 0);
  ASSERT_EQ(curve.size(), 361U);
  double least_deg = 0, most_deg = 0;
  for (const auto& [heading_deg, error_deg] : curve) {
    const double h = heading_deg * kDegree;
    EXPECT_NEAR(error_deg, -(5 * std::sin(h) - 5 * std::cos(h) + 2 * std::sin(2 * h) + 2 * std::cos(2 * h)), 1e-5);
    least_deg = std::min(least_deg, error_deg);
    most_deg = std::max(most_deg, error_deg);
  }
  EXPECT_GT(least_deg, -8);
  EXPECT_LT(most_deg, 10);
  EXPECT_GT(most_deg, 9);
}

TEST(ThesisReport, LevelFieldsAreCirclesOf19MicroteslaAndTheirDistortions) {
  for (const char* const figure : {"2.3", "2.4"}) {
    for (const auto& [east, north] : curve_of(figure, 0, 0)) EXPECT_NEAR(std::hypot(east, north), 19, 1e-5);
    for (const auto& [heading_deg, error_deg] : curve_of(figure, 1, 0))
      EXPECT_NEAR(error_deg, figure == std::string("2.3") ? 0 : 5, 1e-6);
  }
  // Marks: the field points forward when the vehicle heads north, and to port when it heads east.
  const std::vector<std::pair<double, double>> marks{{0, 19}, {-19, 0}, {0, -19}, {19, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto mark = curve_of("2.3", 0, i + 1);
    ASSERT_EQ(mark.size(), 1U);
    EXPECT_NEAR(mark[0].first, marks[i].first, 1e-6);
    EXPECT_NEAR(mark[0].second, marks[i].second, 1e-6);
  }
  double most_deg = 0;
  for (const auto& [starboard, forward] : curve_of("2.5", 0, 0))
    EXPECT_NEAR(std::hypot(starboard - 2.5, forward - 4), 19, 1e-5);
  for (const auto& [heading_deg, error_deg] : curve_of("2.5", 1, 0)) most_deg = std::max(most_deg, error_deg);
  EXPECT_NEAR(most_deg, std::asin(std::hypot(4, 2.5) / 19) / kDegree, 0.01);
  EXPECT_LT(most_deg, 15);
  const auto soft = curve_of("2.6", 1, 0);
  double wave = 0;
  for (std::size_t i = 0; i < 180; ++i) {
    EXPECT_NEAR(soft[i].second, soft[i + 180].second, 2e-6) << "two waves for each turn";
    wave = std::max(wave, std::abs(soft[i].second));
  }
  // An axis ratio r changes a heading by atan((1 - r) / (2 sqrt(r))) at most.
  EXPECT_NEAR(wave, std::atan((1 - 0.8) / (2 * std::sqrt(0.8))) / kDegree, 0.01);
}

TEST(ThesisReport, HardIronIsTheArcSineOfItsSinusoid) {
  const auto error = curve_of("4.7", 0, 0), model = curve_of("4.7", 0, 1);
  EXPECT_EQ(error, curve_of("2.5", 1, 0));
  ASSERT_EQ(model.size(), error.size());
  double apart_deg = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    EXPECT_NEAR(std::sin(error[i].second * kDegree), model[i].second * kDegree, 1e-6);
    apart_deg = std::max(apart_deg, std::abs(error[i].second - model[i].second));
  }
  EXPECT_NEAR(apart_deg, 0.15, 0.005);
}

/// A row of the page as the numbers of JSON make it.
std::string row_of(const nlohmann::json& json, const std::vector<ThesisColumn>& columns) {
  std::string row = "<tr>";
  for (const ThesisColumn& column : columns) {
    const auto& value = json.at(column.key);
    ThesisCell cell;
    if (value.is_number()) cell.number = value.get<double>();
    if (value.is_string()) cell.text = value.get<std::string>();
    row += "<td>" + shown_cell(cell, column) + "</td>";
  }
  return row + "</tr>";
}

TEST(ThesisReport, PageAndJsonAgree) {
  int rows = 0;
  for (const ThesisTable& table : thesis_tables(thesis_sample())) {
    for (const ThesisTablePart& part : table.parts) {
      for (const auto& row : sample_json()["tables"][table.id]["parts"][part.key]) {
        EXPECT_NE(sample_page().find(row_of(row, part.columns)), std::string::npos) << table.id << row.dump();
        ++rows;
      }
    }
  }
  EXPECT_EQ(rows, 2 * 8 + 2 * 8 + 8 + 5 * 8 + 5 + 2 * 8);
}

TEST(ThesisReport, NumbersOfTheThesisAreAsPrinted) {
  const auto& table = sample_json()["tables"]["3.1"]["parts"]["bias_rad_s"][6];
  EXPECT_EQ(table["path"], 7);
  EXPECT_EQ(table["thesis"], -0.0729);
  EXPECT_EQ(table["thesis_percent"], 34.38);
  EXPECT_NEAR(table["recomputed_percent"].get<double>(), 25.29, 0.0051);
  // Errors in units of the bound follow from the other columns.
  EXPECT_NEAR(table["noise_navcal_bounds"].get<double>(),
              table["noise_navcal_percent"].get<double>() / table["bound_percent"].get<double>(), 1e-9);
  EXPECT_EQ(sample_json()["tables"]["4.1"]["parts"]["C"][0]["thesis_percent"], -13.11);
  EXPECT_NE(sample_page().find("<td>not reached</td>"), std::string::npos);
}

TEST(ThesisReport, DisagreementsOfTheThesisAreTold) {
  EXPECT_NE(sample_page().find("axis of its figure 4.3(d) reaches from -6 to 3 degrees"), std::string::npos);
  for (const auto& erratum : thesis_errata()) {
    ASSERT_EQ(erratum.size(), 2U);
    EXPECT_NE(sample_page().find(escaped(erratum[1])), std::string::npos);
  }
}

TEST(ThesisReport, CellsHaveNoNegativeZero) {
  EXPECT_EQ(shown_cell(-0.00001, {"", "", 4}), "0.0000");
  EXPECT_EQ(shown_cell(-0.00006, {"", "", 4}), "-0.0001");
  EXPECT_EQ(shown_cell(-0.4, {"", "", 0}), "0");
  EXPECT_EQ(shown_cell(ThesisCell(), {"", "", 4}), "-");
  EXPECT_EQ(shown_cell(std::string("no"), {"", "", 4}), "no");
}

}  // namespace
}  // namespace navcal::report
