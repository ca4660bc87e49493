// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace navcal::cli {
namespace {

using Colour = WatchView::Colour;

std::string health(double uptime_s, int frames, const std::string& alarms = "[]", int dropped = 0) {
  return R"({"class":"HEALTH","alarms":)" + alarms + R"(,"uptime_s":)" + std::to_string(uptime_s) +
         R"(,"ports":[{"device":"imu","state":"running","reason":"","frames":)" + std::to_string(frames) +
         R"(,"bad":2,"skipped":7,"lost":1}],"log":{"state":"writing","reason":"","file":"/x/navcal-1.mcap","bytes":1500000,"queued":2000,"lost":0},"dropped":)" +
         std::to_string(dropped) + "}";
}

bool page_has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(WatchView, AlarmsComeFirstAndInRed) {
  WatchView view;
  view.take(health(1, 20, R"([{"alarm":"leak_forward","device":"imu"}])"));
  const std::string page = view.page(Colour::ansi);
  EXPECT_EQ(page.rfind("\x1b[1;37;41m ALARM leak_forward (imu)", 0), 0U) << page;
  EXPECT_EQ(view.page(Colour::none).find('\x1b'), std::string::npos);
  EXPECT_EQ(view.line().rfind("ALARM leak_forward (imu)", 0), 0U);
}

TEST(WatchView, RatesComeFromTheDifferenceOfReports) {
  WatchView view;
  view.take(health(10, 200));
  view.take(health(12, 240));
  EXPECT_TRUE(page_has(view.page(Colour::none), "20.0")) << view.page(Colour::none);
}

TEST(WatchView, AReportOnAChangeDoesNotDistortTheRate) {
  WatchView view;
  view.take(health(10, 200));
  view.take(health(11, 220));
  view.take(health(11.01, 221));
  view.take(health(12, 240));
  EXPECT_TRUE(page_has(view.line(), "imu running 20.0/s")) << view.line();
}

TEST(WatchView, TheHeadingOfADeviceStaysWhileItsOtherReportsCome) {
  WatchView view;
  const std::string begin = R"({"class":"ATT","device":"rov",)";
  view.take(begin + R"("heading":93.4,"north":"true","heading_source":"autopilot","pitch":1,"roll":2})");
  view.take(begin + R"("mag_len":50.25})");
  view.take(begin + R"("gyro_z":0.5})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "heading 93.4 deg true by autopilot, pitch 1.0"))
      << view.page(Colour::none);
  EXPECT_TRUE(page_has(view.page(Colour::none), "field 50.25 uT"));
  view.take(begin + R"("heading":95.5,"north":"true","heading_source":"calibration"})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "heading 95.5 deg true by calibration"));
}

TEST(WatchView, TellsAReckonedPositionFromOneByFixes) {
  WatchView view;
  const std::string begin = R"({"class":"NAV","device":"navigation","position":)";
  view.take(begin + R"("none","lat":null,"heading_rad":1.5707963,"speed_m_s":1.02,"depth_m":0.5})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "no position before the first fix, heading 90.0 deg true"));
  EXPECT_FALSE(page_has(view.line(), "reckoned"));
  view.take(begin + R"("reckoned","lat":37.5,"lon":-80,"north_std_m":3,"east_std_m":4,"since_fix_s":83.2,)" +
            R"("since_fix_m":91.4})");
  view.take(R"({"class":"TPV","device":"navigation","mode":2,"lat":37.5,"lon":-80})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "37.5000000 -80.0000000, off by 5.0 m"));
  EXPECT_TRUE(page_has(view.page(Colour::none), "RECKONED: 83 s and 91 m since the last fix"));
  EXPECT_TRUE(page_has(view.line(), "reckoned 37.5000000 -80.0000000 off by 5.0 m; "));
  EXPECT_FALSE(page_has(view.page(Colour::none), "2D")) << "said once";
  view.take(begin + R"("fixes","lat":37.5,"lon":-80,"north_std_m":0.3,"east_std_m":0.4})");
  EXPECT_FALSE(page_has(view.page(Colour::none), "RECKONED"));
  view.take(R"({"class":"NAV","position":7,"lat":"x","north_std_m":[]})");
  EXPECT_FALSE(view.page(Colour::none).empty());
}

TEST(WatchView, TellsWhetherTheDopplerLogHasBottomLock) {
  WatchView view;
  const std::string begin = R"({"class":"NAV","device":"navigation","position":"none","bottom_lock":)";
  view.take(begin + "true}");
  EXPECT_TRUE(page_has(view.page(Colour::none), ", bottom lock"));
  view.take(begin + "false}");
  EXPECT_TRUE(page_has(view.page(Colour::none), ", NO BOTTOM LOCK"));
  view.take(begin + "null}");
  EXPECT_FALSE(page_has(view.page(Colour::none), "ottom lock"));
  EXPECT_FALSE(page_has(view.page(Colour::none), "BOTTOM LOCK"));
}

TEST(WatchView, EveryKindOfReportIsShown) {
  WatchView view;
  view.take(health(1, 20, "[]", 3));
  view.take(
      R"({"class":"ATT","device":"compass","heading":123.4000,"pitch":1.5,"roll":-2.5,"mag_len":50.1,"dip":60.0})");
  view.take(R"({"class":"ATT","device":"imu","depth":4.25,"gyro_x":1,"gyro_y":2,"gyro_z":3})");
  view.take(R"({"class":"TPV","device":"gps","mode":3,"lat":57.71283,"lon":12.02259,"speed":0.31})");
  view.take(R"({"class":"MOTOR","device":"motor","rpm":800,"current_A":1.5,"fins_rad":[0.1,null,-0.1]})");
  view.take(R"({"class":"TIME","source":"gps","bound":0.0125})");
  const std::string page = view.page(Colour::none);
  for (const char* part : {"heading 123.4", "depth 4.25 m", "3D 57.7128300 12.0225900",
                           "800 rpm, 1.50 A, fins 5.7 - -5.7", "log: writing navcal-1.mcap, 1.5 MB, 2 kB queued",
                           "UTC from gps, to within 0.012500 s", "missed 3 reports"}) {
    EXPECT_TRUE(page_has(page, part)) << part << "\n" << page;
  }
}

TEST(WatchView, ShowsWhichPortServesWhat) {
  WatchView view;
  view.take(R"({"class":"HEALTH","ports":[],"sources":{"heading":"compass","field":"compass","position":"gps",)"
            R"("velocity":"gps","shaft":"motor"}})");
  EXPECT_TRUE(page_has(view.page(Colour::none),
                       "heading and field by compass, position and velocity by gps, shaft by motor\n"))
      << view.page(Colour::none);
  view.take(R"({"class":"HEALTH","ports":[],"sources":{"heading":7}})");
  EXPECT_FALSE(view.page(Colour::none).empty());
}

TEST(WatchView, SaysWhichNorthAHeadingIsFrom) {
  WatchView view;
  view.take(R"({"class":"ATT","device":"compass","heading":10,"north":"magnetic"})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "heading 10.0 deg magnetic,"));
  view.take(R"({"class":"ATT","device":"compass","heading":10,"north":"true"})");
  EXPECT_TRUE(page_has(view.page(Colour::none), "heading 10.0 deg true,"));
}

TEST(WatchView, ALostConnectionIsForgotten) {
  WatchView view;
  view.take(health(1, 20, R"([{"alarm":"leak_aft","device":"imu"}])"));
  view.clear();
  EXPECT_FALSE(page_has(view.page(Colour::none), "ALARM"));
}

TEST(WatchView, NothingFromTheNetworkMovesTheCursor) {
  WatchView view;
  view.take(
      R"({"class":"HEALTH","alarms":[{"alarm":"\u001b[2J","device":"a"}],"ports":[{"device":"\u001b[H","state":"x"}],"log":{"state":"\u0007"}})");
  for (const char c : view.page(Colour::none)) {
    EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
  }
}

struct Shown {
  const char *kind, *report, *part;
};
/// A report of each class, and what the page shows of it.
constexpr Shown kShown[] = {
    {"HEALTH", R"({"class":"HEALTH","alarms":[{"alarm":"leak_aft","device":"imu"}],"uptime_s":1,"ports":[]})",
     "ALARM leak_aft (imu)"},
    {"ATT", R"({"class":"ATT","device":"compass","heading":123.4,"pitch":1.5,"roll":-2.5})", "heading 123.4"},
    {"TPV", R"({"class":"TPV","device":"gps","mode":3,"lat":57.71283,"lon":12.02259})",
     "3D 57.7128300 12.0225900"},
    {"MOTOR", R"({"class":"MOTOR","device":"motor","rpm":800,"current_A":1.5,"fins_rad":[0,0,0]})",
     "800 rpm, 1.50 A"},
    {"TIME", R"({"class":"TIME","source":"gps","bound":0.0125})", "UTC from gps, to within 0.012500 s"},
};

WatchView view_of_all_kinds() {
  WatchView view;
  for (const Shown& shown : kShown) view.take(shown.report);
  return view;
}

TEST(WatchView, AWrongTypeChangesNothingOfOtherReportsAndIsReplacedByTheNextReport) {
  for (const char* kind : {"HEALTH", "ATT", "TPV", "MOTOR", "TIME", "LOG"}) {
    for (const char* key : {"ports", "alarms", "log", "fins_rad", "heading", "depth", "lat", "uptime_s", "bound",
                            "device", "dropped"}) {
      for (const char* value : {"1", "null", "\"x\"", "[]", "{}", "[1]", "[{}]", "[[]]", "-1", "1e300"}) {
        WatchView view = view_of_all_kinds();
        const std::string wrong = std::string("{\"class\":\"") + kind + "\",\"" + key + "\":" + value + "}";
        view.take(wrong);
        for (const Shown& shown : kShown) {
          if (std::string(kind) == shown.kind) continue;
          EXPECT_TRUE(page_has(view.page(Colour::none), shown.part)) << wrong << '\n' << view.page(Colour::none);
        }
        for (const Shown& shown : kShown) view.take(shown.report);
        for (const Shown& shown : kShown) {
          EXPECT_TRUE(page_has(view.page(Colour::none), shown.part)) << wrong << '\n' << view.page(Colour::none);
        }
        EXPECT_FALSE(page_has(view.line(), "\n")) << wrong;
      }
    }
  }
}

TEST(WatchView, ALineThatIsNoReportChangesNothing) {
  const std::string pieces[] = {"\"class\"",
                                ":",
                                "\"HEALTH\"",
                                "\"ATT\"",
                                "\"TPV\"",
                                "\"MOTOR\"",
                                "\"TIME\"",
                                "{",
                                "}",
                                "[",
                                "]",
                                ",",
                                "1",
                                "null",
                                "\"ports\"",
                                "\"alarms\"",
                                "\"device\"",
                                "\"log\"",
                                "\"fins_rad\"",
                                "\"heading\"",
                                "\"x\"",
                                "\"frames\"",
                                "\"uptime_s\""};
  std::mt19937 random(7);
  WatchView view = view_of_all_kinds();
  const std::string page = view.page(Colour::ansi), line = view.line();
  int without_class = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = i % 2 == 0 ? "{\"class\":" : "{\"device\":";
    for (auto n = random() % 12; n > 0; --n) text += pieces[random() % std::size(pieces)];
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_object() && json.contains("class")) continue;
    without_class += json.is_object() ? 1 : 0;
    view.take(text);
    ASSERT_EQ(view.line(), line) << text;
  }
  EXPECT_EQ(view.page(Colour::ansi), page);
  EXPECT_GT(without_class, 0) << "an object without a class is among them";
}

}  // namespace
}  // namespace navcal::cli
