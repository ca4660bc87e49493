// SPDX-License-Identifier: Apache-2.0
// A calibrator is one unit and one line: with a row more in the table it is judged, shown, stored and ordered
// about.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "calib/suite/suite.h"
#include "record/json/calibration_json.h"
#include "report/calibrate_report.h"
#include "tests/calib/suite/mean_pitch.h"

namespace navcal::report {
namespace {

using calib::Calibrator;
using Json = nlohmann::json;

class AddedCalibrator : public testing::Test {
 protected:
  AddedCalibrator() {
    for (int i = 0; i < 200; ++i) {
      calib::CompassReading reading;
      reading.time_s = 0.1 * i;
      reading.heading_rad = 1 + 0.001 * (i % 10);
      reading.pitch_rad = 0.1 + 0.0001 * (i % 2);
      reading.roll_rad = 0.0001 * (i % 3);
      suite_.put(reading);
    }
    suite_.finish();
  }

  const calib::ScopedCalibrator line_{calib::test::kMeanPitch};
  const Calibrator mean_pitch_ = *calib::calibrator_named("mean_pitch");
  calib::Suite suite_{{}, {.compass = true}};
};

TEST_F(AddedCalibrator, IsInTextPageAndJson) {
  const calib::Report report = suite_.report();
  EXPECT_NE(calibrate_text(report, 20).find("Mean pitch"), std::string::npos);
  EXPECT_NE(calibrate_text(report, 20).find("mean 5.73"), std::string::npos) << calibrate_text(report, 20);
  const analysis::CalibrateHistory history{config::Settings{}};
  PageSource source;
  source.files = {"dive.cap"};
  EXPECT_NE(calibrate_page(report, history, source).find("Mean pitch"), std::string::npos);

  std::string text;
  record::append_calibrate_json(text, report);
  const Json json = Json::parse(text);
  EXPECT_TRUE(json.at("mean_pitch").at("accepted").get<bool>());
  EXPECT_NEAR(json.at("mean_pitch").at("estimate").at("mean_deg").get<double>(), 5.73, 0.01);
  EXPECT_EQ(json.at("gyro").at("reason"),
            "the recording lacks an instrument: it takes a compass and an inertial card (protocol imu-card)");

  const Json status = Json::parse(record::calib_lines(report, 0).front());
  const Json& last = status.at("calibrators").back();
  EXPECT_EQ(last.at("calibrator"), "mean_pitch");
  EXPECT_EQ(last.at("verdict"), "shadow");
  EXPECT_TRUE(last.at("in_force").is_null());
}

TEST_F(AddedCalibrator, IsAcceptedAndRolledBackByItsName) {
  EXPECT_EQ(suite_.accept(mean_pitch_), "");
  const auto& in_force = suite_.in_force();
  const auto name = in_force.name();
  EXPECT_EQ(name.number, 1U);
  calib::CompassReading reading;
  reading.heading_rad = 1;
  EXPECT_NEAR(corrected_heading(in_force.correction(), reading).value(), 0.9, 0.001);

  std::string text;
  record::append_json(
      text, {}, {7, pipeline::CalibrationChange::Cause::accept, mean_pitch_, name, in_force.correction(), {}});
  EXPECT_NEAR(Json::parse(text).at("in_force").at("mean_pitch").at("mean_deg").get<double>(), 5.73, 0.01);
  EXPECT_EQ(record::calibration_from_json(text)->calibrator, mean_pitch_);

  calib::Archive saving;
  suite_.archive(saving);
  calib::Suite later({}, {.compass = true});
  calib::Archive restoring{std::string_view(saving.bytes())};
  later.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  EXPECT_EQ(later.in_force().name(), name);
  EXPECT_EQ(later.roll_back(mean_pitch_), "");
  EXPECT_TRUE(later.report().find(mean_pitch_)->held);
  EXPECT_FALSE(corrected_heading(later.in_force().correction(), reading));
  EXPECT_EQ(later.start(mean_pitch_), "");
  EXPECT_NE(later.accept(mean_pitch_), "");
}

}  // namespace
}  // namespace navcal::report
