// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
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
  EXPECT_EQ(links, 6 + 25);
  EXPECT_EQ(page.find("http"), std::string::npos) << "a page needs nothing from elsewhere";
}

TEST(ThesisReport, OnlyThePicturesHaveNoPanels) {
  for (const auto& [id, figure] : sample_json()["figures"].items()) {
    EXPECT_EQ(figure["panels"].empty(), id == "1.1" || id == "1.2") << id;
    EXPECT_FALSE(figure["caption"].get<std::string>().empty()) << id;
    for (const auto& panel : figure["panels"]) {
      for (const auto& curve : panel["curves"]) {
        EXPECT_FALSE(curve["x"].empty()) << id << panel["title"];
        EXPECT_EQ(curve["x"].size(), curve["y"].size()) << id << panel["title"];
      }
    }
  }
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
