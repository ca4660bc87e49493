// SPDX-License-Identifier: Apache-2.0
// Bad input, one kind after another, in a good recording: the estimates stay, and what was left out is counted.
#include <gtest/gtest.h>

#include <limits>

#include "calib/suite/suite.h"
#include "tests/calib/suite/suite_drive.h"

namespace navcal::calib {
namespace {

using namespace test;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Case {
  std::string name;
  Stream stream;
  Rejection reason;
  /// Spoils reading `i` of the stream or adds others; returns what goes to the suite in its place.
  std::function<std::vector<Reading>(Reading, int)> spoil;
};

CompassReading& compass(Reading& reading) { return std::get<CompassReading>(reading); }
RateReading& rate(Reading& reading) { return std::get<RateReading>(reading); }

std::vector<Case> cases() {
  const auto now_and_then = [](int i) { return i % 17 == 5; };
  return {
      {"heading not a number", Stream::compass, Rejection::not_finite,
       [=](Reading r, int i) {
         if (now_and_then(i)) compass(r).heading_rad = kNan;
         return std::vector{r};
       }},
      {"heading absurd", Stream::compass, Rejection::absurd,
       [=](Reading r, int i) {
         if (now_and_then(i)) compass(r).heading_rad = 65535.0;
         return std::vector{r};
       }},
      {"rate infinite", Stream::rate, Rejection::not_finite,
       [=](Reading r, int i) {
         if (now_and_then(i)) rate(r).rate_rad_s.z() = std::numeric_limits<double>::infinity();
         return std::vector{r};
       }},
      {"rate saturated", Stream::rate, Rejection::saturated,
       [=](Reading r, int i) {
         if (now_and_then(i)) {
           rate(r).rate_rad_s.z() = 3.5;
           rate(r).saturated = true;
         }
         return std::vector{r};
       }},
      {"stamp repeated", Stream::compass, Rejection::repeated,
       [=](Reading r, int i) {
         std::vector out{r};
         if (now_and_then(i)) {
           compass(r).heading_rad = 0.1;
           out.push_back(r);
         }
         return out;
       }},
      {"stamp reversed", Stream::compass, Rejection::reversed,
       [=](Reading r, int i) {
         std::vector out{r};
         if (now_and_then(i)) {
           compass(r).time_s -= 3;
           compass(r).heading_rad = 0.1;
           out.push_back(r);
         }
         return out;
       }},
      {"an error of unknown effect", Stream::compass, Rejection::faulty,
       [=](Reading r, int i) {
         if (i >= 100 && i < 120) {
           compass(r).faulty = true;
           compass(r).heading_rad = 0.1;
         }
         return std::vector{r};
       }},
      {"heading frozen", Stream::compass, Rejection::frozen,
       [=](Reading r, int i) {
         if (i >= 100 && i < 140) compass(r).heading_rad = 1.5;
         return std::vector{r};
       }},
      {"rates frozen", Stream::rate, Rejection::frozen,
       [=](Reading r, int i) {
         if (i >= 100 && i < 140) {
           rate(r).rate_rad_s = {0, 0, 0.3};
           rate(r).yaw_rate_b_rad_s = 0.3;
         }
         return std::vector{r};
       }},
      {"motor switched on in mid-turn", Stream::compass, Rejection::motor_switched,
       [=](Reading r, int i) {
         std::vector<Reading> out;
         const double time_s = compass(r).time_s;
         // Its field swings for a second; the card is a little late to say so.
         if (i >= 200 && i < 210)
           compass(r).heading_rad = *compass(r).heading_rad + 0.5 * std::exp(-0.3 * (i - 200));
         out.push_back(MotorReading{time_s, i < 202 ? 0.0 : 800.0});
         out.push_back(r);
         return out;
       }},
  };
}

class BadInput : public testing::TestWithParam<Case> {};

TEST_P(BadInput, SpoilsNoEstimateAndIsCounted) {
  const Case& test = GetParam();
  Suite suite(thesis_options(), {true, true, false, true});
  int compasses = 0, rates = 0;
  for (const Reading& reading : readings_along("path2", thesis_deviation(), {}, 5)) {
    const Stream stream = stream_of(reading);
    const int i = stream == Stream::compass ? compasses++ : rates++;
    if (stream != test.stream) {
      suite.put(reading);
    } else {
      for (const Reading& spoilt : test.spoil(reading, i)) suite.put(spoilt);
    }
  }
  suite.finish();
  const Report report = suite.report();
  EXPECT_GE(report.gate.left_out[static_cast<std::size_t>(test.stream)][static_cast<std::size_t>(test.reason)],
            10U);
  ASSERT_TRUE(report.estimates.gyro && report.estimates.compass);
  const auto* gyro = report.find(Calibrator::gyro);
  EXPECT_NEAR(report.estimates.gyro->scale, kTrueScale, 5 * gyro->quantity("scale")->std);
  EXPECT_NEAR(report.estimates.gyro->bias_rad_s, kTrueBias_rad_s, 5 * gyro->quantity("bias_rad_s")->std);
  EXPECT_LT(gyro->quantity("scale")->std, 0.02);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_NEAR(report.estimates.compass->coefficients_rad[i], thesis_deviation()[static_cast<Eigen::Index>(i)],
                0.02)
        << i;
  }
}

std::string case_name(const testing::TestParamInfo<Case>& tested) {
  std::string name = tested.param.name;
  for (char& c : name) c = c == ' ' || c == '-' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Suite, BadInput, testing::ValuesIn(cases()), case_name);

}  // namespace
}  // namespace navcal::calib
