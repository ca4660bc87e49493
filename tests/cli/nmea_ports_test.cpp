// SPDX-License-Identifier: Apache-2.0
// Recordings with several NMEA devices, through `navcal replay` and `navcal calibrate`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

class NmeaPorts : public CalibrateProgram {
 protected:
  static std::string line(double time_s, const std::string& port, const std::string& body) {
    unsigned sum = 0;
    for (const char c : body) sum ^= static_cast<unsigned char>(c);
    char end[8];
    std::snprintf(end, sizeof end, "*%02X\r\n", sum);
    std::string hex;
    for (const char c : "$" + body + end) {
      char two[3];
      std::snprintf(two, sizeof two, "%02x", static_cast<unsigned char>(c));
      hex += two;
    }
    char time[32];
    std::snprintf(time, sizeof time, "%.9f", 1767225600 + time_s);
    return std::string(time) + " " + port + " < " + hex + "\n";
  }
  /// Two minutes of a sounder, a receiver and a compass with heading, rate of turn and tilt; the ports in the
  /// order given. The compass is silent from `silent_s` on.
  static std::string recording(const std::vector<std::string>& order, double silent_s = 1e9,
                               const std::string& spare = "") {
    std::string text = "#capture 1\n";
    for (const std::string& port : order) text += "#port " + port + " nmea 38400\n";
    for (int tick = 0; tick < 1200; ++tick) {
      const double t = 0.1 * tick, heading_deg = std::fmod(3 * t, 360);
      char body[100];
      if (t < silent_s) {
        std::snprintf(body, sizeof body, "HCHDG,%.1f,,,,", heading_deg);
        text += line(t + 0.01, "compass", body);
        text += line(t + 0.02, "compass", "HEROT,180.0,A");
        text += line(t + 0.03, "compass", "HCXDR,A,0.1,D,PTCH,A,-0.2,D,ROLL");
      }
      if (!spare.empty()) {
        std::snprintf(body, sizeof body, "HCHDG,%.1f,,,,", heading_deg);
        text += line(t + 0.04, spare, body);
      }
      if (tick % 10 != 0) continue;
      const int second = tick / 10;
      std::snprintf(body, sizeof body, "GPRMC,00%02d%02d.00,A,3714.%04d,N,08025.0000,W,2.0,010.0,010126,,,A",
                    second / 60, second % 60, second * 5);
      text += line(t + 0.05, "receiver", body);
      text += line(t + 0.06, "sounder", "SDDPT,5.0,0.0");
    }
    return text;
  }
  static int count(const std::string& text, std::string_view word) {
    int n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  }
};

TEST_F(NmeaPorts, EachServesWhatItDeliversInAnyOrder) {
  std::vector<std::string> order{"compass", "receiver", "sounder"};
  do {
    write("a.cap", recording(order));
    const std::string out = output_of("replay a.cap");
    EXPECT_GT(count(out, "\"NAV\""), 100) << order[0] << ' ' << order[1];
    EXPECT_GT(count(out, "\"lat\":37."), 80) << order[0] << ' ' << order[1];
    EXPECT_EQ(count(out, "\"heading_rad\":null,\"heading_std"), 0) << order[0];
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_F(NmeaPorts, RateOfTurnAndTiltAloneAreNoReadingsOfAHeading) {
  write("a.cap", recording({"sounder", "receiver", "compass"}));
  const auto json = calibrated("a.cap");
  EXPECT_GT(json["left_out"]["compass"]["taken"], 1160) << "less those before it is known which port delivers";
  EXPECT_LE(json["left_out"]["compass"]["taken"], 1200);
}

TEST_F(NmeaPorts, ACompassWithoutFieldIsNotToldToTurn) {
  write("a.cap", recording({"sounder", "receiver", "compass"}));
  const auto json = calibrated("a.cap");
  EXPECT_EQ(json["magnetometer"]["reason"], "the compass gives headings without the field that it measures");
}

TEST_F(NmeaPorts, ASecondCompassServesWhileTheFirstIsSilent) {
  write("a.cap", recording({"compass", "receiver", "spare", "sounder"}, 60, "spare"));
  const std::string out = output_of("replay a.cap");
  EXPECT_EQ(count(out, "\"source.heading\""), 1);
  EXPECT_NE(out.find("serves the heading, because compass is silent"), std::string::npos);
}

}  // namespace
}  // namespace navcal::cli::test
