// SPDX-License-Identifier: Apache-2.0
#include "report/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/html_page.h"
#include "report/svg_rose.h"
#include "tests/report/markup.h"

namespace navcal::cli {
namespace {

TEST(SvgPlot, GivenTicksAndWordsAreWrittenAsTheyAre) {
  report::SvgPlot plot("a", {"x", {0, 10}, 0, {{2, "N"}, {5, "<E>"}}}, {"y", {0, 1}});
  plot.word({5, 0.5}, "bow");
  plot.word({50, 0.5}, "outside");
  const std::string svg = plot.svg();
  EXPECT_NE(svg.find(">N</text>"), std::string::npos);
  EXPECT_NE(svg.find(">&lt;E&gt;</text>"), std::string::npos);
  EXPECT_NE(svg.find(">bow</text>"), std::string::npos);
  EXPECT_EQ(svg.find("outside"), std::string::npos);
}

TEST(SvgPlot, AWholeRangeHoldsOutliersToo) {
  std::vector<double> values(1000, 1.0);
  values[500] = 100;
  values[501] = NAN;
  EXPECT_GE(report::whole_range_of(values).most, 100);
  EXPECT_LT(report::range_of(values).most, 100);
  EXPECT_GT(report::whole_range_of({}).length(), 0);
  EXPECT_GT(report::whole_range_of({7}).length(), 0);
}

using test::count;
using test::flaw_in;

report::SvgPlot plot() { return {"a < b", {"x & y", {0, 10}}, {"\"y\"", {-1, 1}}}; }

TEST(SvgPlot, TheCheckOfTheTestsFindsFlaws) {
  EXPECT_EQ(flaw_in("<a><b x=\"1\"/>text &amp; more</a>"), "");
  for (const char* bad : {"<a><b></a>", "<a>", "</a>", "<a>&</a>", "<a>1 > 2</a>", "<a b=\"<\"/>", "text", "<a"}) {
    EXPECT_NE(flaw_in(bad), "") << bad;
  }
}

TEST(SvgPlot, WhateverIsDrawnIsWellFormed) {
  report::SvgPlot empty = plot();
  EXPECT_EQ(flaw_in(empty.svg()), "");
  report::SvgPlot full = plot();
  const std::vector<report::Point> points{{0, 0}, {5, 0.5}, {NAN, 0}, {7, INFINITY}, {10, -1}, {1e300, 1e300}};
  full.band(report::SvgPlot::Ink::after, "<band>", points, points);
  full.points(report::SvgPlot::Ink::before, "dots & more", points);
  full.line(report::SvgPlot::Ink::fit, "line", points);
  full.level(0);
  EXPECT_EQ(flaw_in(full.svg()), "");
  EXPECT_EQ(full.svg().find("nan"), std::string::npos);
  EXPECT_EQ(full.svg().find("inf"), std::string::npos);
}

TEST(SvgPlot, PointsOutsideAreLeftOut) {
  report::SvgPlot some = plot();
  const std::vector<report::Point> points{{1, 0}, {2, 0}, {11, 0}, {3, 2}, {-1, 0}};
  some.points(report::SvgPlot::Ink::before, "", points);
  EXPECT_EQ(count(some.svg(), "h0"), 2);
}

TEST(SvgPlot, OutliersDoNotStretchAnAxis) {
  std::vector<double> rates_deg_s;
  for (int i = 0; i < 1000; ++i) rates_deg_s.push_back(20 * std::sin(0.1 * i));
  const report::Range plain = report::range_of(rates_deg_s);
  EXPECT_NEAR(plain.length(), 40, 6);
  for (int i = 0; i < 50; ++i) rates_deg_s[static_cast<std::size_t>(20 * i)] = i % 2 == 0 ? 2e5 : -3e4 * i;
  EXPECT_NEAR(report::range_of(rates_deg_s).length(), plain.length(), 0.1 * plain.length());
}

TEST(SvgPlot, RareMotionAndLongTailsStayWithinTheAxis) {
  std::vector<double> mostly_still, exponential;
  for (int i = 0; i < 1000; ++i) {
    mostly_still.push_back(i % 20 == 0 ? 10 * std::sin(i) : 0.5 * std::sin(i));
    exponential.push_back(-std::log((i + 0.5) / 1000));
  }
  EXPECT_GT(report::range_of(mostly_still).most, 9);
  EXPECT_GT(report::range_of(exponential).most, 5.5);
}

TEST(SvgPlot, WhereDataAreCutATriangleSaysSo) {
  report::SvgPlot some = plot();
  const std::vector<report::Point> within{{1, 0}, {2, 0.5}}, beyond{{1, 5}, {2, -7}, {3, 0}, {2, -9}, {20, 9}};
  some.points(report::SvgPlot::Ink::before, "", within);
  EXPECT_EQ(count(some.svg(), "class=\"cut\""), 0);
  some.line(report::SvgPlot::Ink::before, "", beyond);
  EXPECT_EQ(count(some.svg(), "class=\"cut\""), 1);
  EXPECT_EQ(count(some.svg(), "l3 -5l3 5Z"), 1);
  EXPECT_EQ(count(some.svg(), "l3 5l3 -5Z"), 1) << "two at one place are one mark";
  EXPECT_NE(some.svg().find(">beyond the axes: 1 above, 2 below, 1 right</text>"), std::string::npos)
      << some.svg();
  EXPECT_EQ(flaw_in(some.svg()), "");
}

TEST(SvgPlot, WhatLiesToTheSidesIsMarkedAndCounted) {
  report::SvgPlot some = plot();
  const std::vector<report::Point> points{{-3, 0}, {-4, 9}, {12, 0.5}, {5, 0}, {NAN, 0}};
  some.points(report::SvgPlot::Ink::before, "", points);
  EXPECT_EQ(count(some.svg(), "l-5 3l5 3Z"), 2) << "to the left";
  EXPECT_EQ(count(some.svg(), "l5 3l-5 3Z"), 1) << "to the right";
  EXPECT_NE(some.svg().find(">beyond the axes: 2 left, 1 right</text>"), std::string::npos) << some.svg();
  EXPECT_EQ(flaw_in(some.svg()), "");
}

TEST(SvgPlot, WhatDoesNotVaryIsShownOnARoundScale) {
  for (const double value : {780.0, -3e-5, 0.0}) {
    const report::Range range = report::range_of({value, value, value});
    EXPECT_LT(range.least, value);
    EXPECT_GT(range.most, value);
    EXPECT_GE(range.length(), 0.01 * std::abs(value));
  }
  const report::Range varied = report::range_of({1, 2, 3});
  EXPECT_LT(varied.least, 1);
  EXPECT_GT(varied.length(), 2);
}

TEST(SvgPlot, NothingToDrawLeavesNoTraceInTheLegend) {
  report::SvgPlot some = plot();
  some.points(report::SvgPlot::Ink::before, "dots", {});
  some.line(report::SvgPlot::Ink::before, "line", {});
  some.band(report::SvgPlot::Ink::before, "band", {}, {});
  EXPECT_EQ(some.svg(), plot().svg());
}

TEST(SvgPlot, ALineEndsWhereAPointIsMissing) {
  report::SvgPlot some = plot();
  const std::vector<report::Point> points{{0, 0}, {1, 0}, {NAN, 0}, {2, 0}, {3, 0}};
  const int before = count(some.svg(), "L");
  some.line(report::SvgPlot::Ink::fit, "", points);
  EXPECT_EQ(count(some.svg(), "L") - before, 2);
}

TEST(SvgPlot, RoundValuesAreRoundAndWithin) {
  EXPECT_EQ(report::round_values({0, 10}, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  for (const double scale : {1e-9, 0.37, 1.0, 123456.0}) {
    const report::Range range{-0.31 * scale, 1.7 * scale};
    const auto values = report::round_values(range, 6);
    EXPECT_GE(values.size(), 3U);
    EXPECT_LE(values.size(), 13U);
    for (const double value : values) {
      EXPECT_GE(value, range.least - 1e-9 * scale);
      EXPECT_LE(value, range.most + 1e-9 * scale);
    }
  }
  EXPECT_TRUE(report::round_values({1, 1}, 5).empty());
  EXPECT_TRUE(report::round_values({0, INFINITY}, 5).empty());
}

TEST(SvgPlot, ARangeIsNeverEmptyAndPassesOverTheFewOutermost) {
  for (const auto& values : {std::vector<double>{}, {NAN}, {3}, {0, 0}, {1e12, 1e12}}) {
    const report::Range range = report::range_of(values);
    EXPECT_GT(range.length(), 0);
    EXPECT_TRUE(std::isfinite(range.length()));
  }
  std::vector<double> values(1000, 0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 10);
  values.push_back(1e9);
  EXPECT_LT(report::range_of(values).most, 11);
  EXPECT_GE(report::range_of(values).most, 9);
}

TEST(SvgRose, EverySectorThatWasSeenIsThere) {
  calib::HeadingHistogram rose{};
  EXPECT_EQ(flaw_in(report::svg_rose(rose)), "");
  EXPECT_EQ(count(report::svg_rose(rose), "Z"), 0);
  EXPECT_EQ(report::text_rose(rose), std::string(36, '.'));
  rose[0] = 100;
  rose[35] = 1;
  EXPECT_EQ(count(report::svg_rose(rose), "Z"), 2);
  EXPECT_EQ(report::text_rose(rose), "#" + std::string(34, '.') + ":");
  rose.fill(4'000'000'000U);
  EXPECT_EQ(flaw_in(report::svg_rose(rose)), "");
  EXPECT_EQ(report::text_rose(rose), std::string(36, '#'));
}

TEST(HtmlPage, AnyTextIsWellFormed) {
  const std::string any = "<b> & \"q\" \x01\x7f \xff\xc3 caf\xc3\xa9";
  report::HtmlPage page(any);
  page.fact(any, any, any);
  page.section(any);
  page.paragraph(any);
  page.figures({{any, plot().svg(), any}});
  page.folded_figures(any, {{any, plot().svg(), any}});
  page.table({any}, {{any}, {any}});
  const std::string html = std::move(page).finish();
  EXPECT_EQ(flaw_in(html), "");
  EXPECT_EQ(html.find('\xff'), std::string::npos) << "not UTF-8";
  EXPECT_NE(html.find("caf\xc3\xa9"), std::string::npos);
}

TEST(HtmlPage, LongCellsMayBreakAnywhere) {
  report::HtmlPage page("title");
  page.table({"digest", "name"}, {{std::string(64, 'a'), "short"}});
  const std::string html = std::move(page).finish();
  EXPECT_NE(html.find("<td class=\"long\">aaa"), std::string::npos);
  EXPECT_NE(html.find("<td>short</td>"), std::string::npos);
}

TEST(HtmlPage, NeedsNoOtherFile) {
  report::HtmlPage page("title");
  const std::string html = std::move(page).finish();
  for (const char* outside : {"http:", "https:", "<script", "<link", "src=", "@import", "url("}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
}

}  // namespace
}  // namespace navcal::cli
