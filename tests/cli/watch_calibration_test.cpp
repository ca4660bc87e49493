// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cli/live/watch_view.h"

namespace navcal::cli {
namespace {

constexpr const char* kReport =
    R"({"class":"CALIB","name":"7-1a2b3c4d","calibrators":[)"
    R"({"calibrator":"gyro","verdict":"in_force","accepted":true,"reason":"","manoeuvre":"","coverage":1.0,)"
    R"("held_out_before_deg":3.21,"held_out_after_deg":0.42,"estimate":{"scale":1.1111,"bias_deg_s":-6.37},)"
    R"("std":{"scale":0.0012,"bias_deg_s":0.02}},)"
    R"({"calibrator":"compass","verdict":"refused","reason":"only 220 degrees of the circle were seen",)"
    R"("manoeuvre":"turn through 140 more degrees, headings 220 to 0","coverage":0.61,"held":true}],)"
    R"("heading":{"blocks":12,"before_rms_deg":5.2,"in_force_rms_deg":0.45,"after_rms_deg":0.42},)"
    R"("rose":[50,50,50,5,5,5,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,50]})";

bool report_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WatchCalibration, SaysWhatIsInForceWhatIsRefusedAndWhatToDo) {
  WatchView view;
  view.take(kReport);
  const std::string page = view.page(WatchView::Colour::none);
  for (const char* part :
       {"active calibration: 7-1a2b3c4d", "5.20 deg raw, 0.45 active", "3.21 > 0.42 deg", "scale 1.111 +- 0.0012",
        "bias_deg_s -6.37 +- 0.02", "refused, held", "61 %", "turn through 140 more degrees, headings 220 to 0"}) {
    EXPECT_TRUE(report_has(page, part)) << part << "\n" << page;
  }
  EXPECT_TRUE(report_has(view.line(), "calibration 7-1a2b3c4d"));
}

TEST(WatchCalibration, PartsOfAReportAreShownTogether) {
  WatchView view;
  view.take(R"({"class":"CALIB","name":"1-x","part":1,"parts":2,"calibrators":[{"calibrator":"gyro"}]})");
  view.take(R"({"class":"CALIB","name":"1-x","part":2,"parts":2,"calibrators":[{"calibrator":"swing"}]})");
  const std::string page = view.page(WatchView::Colour::none);
  EXPECT_TRUE(report_has(page, "gyro") && report_has(page, "swing")) << page;
}

TEST(WatchCalibration, TheCompassesOwnCalibrationStandsBesideOurs) {
  WatchView view;
  view.take(R"({"class":"CALIB","name":"1-x","calibrators":[{"calibrator":"compass"}],"tcm2":{"state":"done",)"
            R"("score":{"horizontal":9,"vertical":4,"magnitude":12.3}}})");
  const std::string page = view.page(WatchView::Colour::none);
  EXPECT_TRUE(report_has(page, "tcm2's own") && report_has(page, "horizontal 9 vertical 4 of 9, magnitude 12.3"))
      << page;
  view.take(R"({"class":"CALIB","name":"1-x","calibrators":[],"tcm2":{"state":"not begun","score":null}})");
  EXPECT_TRUE(report_has(view.page(WatchView::Colour::none), "not begun"));
}

TEST(CompassRose, EverySectorHasAPlaceOfItsOwn) {
  std::array<double, 36> none{};
  const auto count = [](const std::vector<std::string>& rows, char c) {
    std::ptrdiff_t n = 0;
    for (const auto& row : rows) n += std::count(row.begin(), row.end(), c);
    return n;
  };
  EXPECT_EQ(count(compass_rose(none), '.'), 36);
  for (std::size_t i = 0; i < none.size(); ++i) {
    auto one = none;
    one[i] = 100;
    EXPECT_EQ(count(compass_rose(one), '#'), 1) << i;
    EXPECT_EQ(count(compass_rose(one), '.'), 35) << i;
  }
}

TEST(CompassRose, NorthIsUpAndEastIsRight) {
  std::array<double, 36> visits{};
  visits[0] = 100;  // headings 0 to 10
  const auto rows = compass_rose(visits);
  EXPECT_NE(rows.front().find('#'), std::string::npos);
  EXPECT_GT(rows.front().find('#'), rows.front().size() / 2);
  visits = {};
  visits[8] = 100;  // 80 to 90
  std::size_t column = 0;
  for (const auto& row : compass_rose(visits)) {
    if (row.find('#') != std::string::npos) column = row.find('#');
  }
  EXPECT_GE(column + 2, rows.front().size());
}

TEST(WatchCalibration, AWrongTypeIsReplacedByTheNextReport) {
  WatchView untouched;
  untouched.take(kReport);
  const std::string page = untouched.page(WatchView::Colour::none), line = untouched.line();
  for (const char* key : {"name", "calibrators", "heading", "rose", "part", "tcm2"}) {
    for (const char* value :
         {"1", "null", "\"x\"", "[]", "{}", "[1]", "[{}]", "[[]]", "-1", "1e300", R"({"score":[],"state":1})",
          R"([{"calibrator":1,"verdict":[],"estimate":[],"std":1,"held":"x"}])"}) {
      WatchView view;
      const std::string wrong = std::string(R"({"class":"CALIB",")") + key + "\":" + value + "}";
      view.take(wrong);
      for (const char c : view.page(WatchView::Colour::none)) {
        EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << wrong << ' ' << static_cast<int>(c);
      }
      EXPECT_FALSE(report_has(view.page(WatchView::Colour::none), "7-1a2b3c4d")) << wrong;
      view.take(kReport);
      EXPECT_EQ(view.page(WatchView::Colour::none), page) << wrong;
      EXPECT_EQ(view.line(), line) << wrong;
    }
  }
}

}  // namespace
}  // namespace navcal::cli
