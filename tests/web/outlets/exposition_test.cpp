// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/exposition.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace navcal::web {
namespace {

TEST(Exposition, AMetricWithoutSamplesLeavesNoLine) {
  Exposition out;
  out.single("absent", "Nothing.", std::nullopt);
  out.metric("also_absent", "Nothing.");
  out.sample({}, std::numeric_limits<double>::quiet_NaN());
  out.sample({{"device", "gps"}}, std::numeric_limits<double>::infinity());
  EXPECT_EQ(out.text(), "");
}

TEST(Exposition, HeadOnceAndBeforeTheFirstSample) {
  Exposition out;
  out.metric("depth_meters", "Depth.");
  out.sample({}, std::nullopt);
  out.sample({{"device", "a"}}, 0.0);
  out.sample({{"device", "b"}, {"axis", "x"}}, -1.5);
  EXPECT_EQ(out.text(),
            "# HELP depth_meters Depth.\n# TYPE depth_meters gauge\n"
            "depth_meters{device=\"a\"} 0\ndepth_meters{device=\"b\",axis=\"x\"} -1.5\n");
}

TEST(Exposition, EscapesWhatTheFormatWants) {
  Exposition out;
  out.metric("m", "a \"quote\", a \\ and\na line");
  out.sample({{"l", "a \"quote\", a \\ and\na line"}}, 1.0);
  EXPECT_EQ(out.text(),
            "# HELP m a \"quote\", a \\\\ and\\na line\n# TYPE m gauge\n"
            "m{l=\"a \\\"quote\\\", a \\\\ and\\na line\"} 1\n");
}

TEST(Exposition, AnyBytesInALabelMakeOneLineOfValidUtf8) {
  for (int byte = 0; byte < 256; ++byte) {
    Exposition out;
    out.metric("m", "M.");
    out.sample({{"l", std::string("<") + static_cast<char>(byte) + ">"}}, 1.0);
    const std::string line = out.text().substr(out.text().rfind("m{"));
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << byte;
    EXPECT_TRUE(line.starts_with("m{l=\"<") && line.ends_with(">\"} 1\n")) << line;
    if (byte >= 0x80) {
      EXPECT_NE(line.find("\xEF\xBF\xBD"), std::string::npos) << byte;
    }
  }
}

TEST(Exposition, HistogramsAreCumulativeAndEndWithAllOfThem) {
  Exposition out;
  out.metric("h", "H.");
  const std::array bounds{0.5, 1.0, 2.0};
  const std::array<std::uint64_t, 5> counts{1, 0, 4, 2, 3};
  out.histogram({{"d", "x"}}, bounds, counts, 7.5);
  EXPECT_EQ(
      out.text(),
      "# HELP h H.\n# TYPE h histogram\nh_bucket{d=\"x\",le=\"0.5\"} 1\nh_bucket{d=\"x\",le=\"1\"} 1\n"
      "h_bucket{d=\"x\",le=\"2\"} 5\nh_bucket{d=\"x\",le=\"+Inf\"} 10\nh_sum{d=\"x\"} 7.5\nh_count{d=\"x\"} 10\n");
}

TEST(Exposition, AHistogramThatWasCutShortKeepsItsBuckets) {
  Exposition out;
  out.metric("h", "H.");
  const std::array bounds{1.0, 2.0};
  out.histogram({}, bounds, {}, std::nullopt);
  EXPECT_NE(out.text().find("h_bucket{le=\"2\"} 0\nh_bucket{le=\"+Inf\"} 0\nh_count 0\n"), std::string::npos)
      << out.text();
}

}  // namespace
}  // namespace navcal::web
