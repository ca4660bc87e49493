// SPDX-License-Identifier: Apache-2.0
// What is told of the calibrators: CALIB, and the answer of `navcal calibrate`.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "record/json/calibration_json.h"

namespace navcal::record {
namespace {

using CalibJson = nlohmann::json;

constexpr double kRadian_deg = 180 / std::numbers::pi;

CalibJson answer_of(const calib::Report& report) {
  std::string text;
  append_calibrate_json(text, report);
  return CalibJson::parse(text);
}

calib::CalibratorReport judged(calib::Calibrator calibrator, calib::HeldOutQuantity quantity) {
  calib::CalibratorReport report;
  report.calibrator = calibrator;
  report.judgement.held_out_quantity = quantity;
  report.judgement.held_out_before = 0.5;
  report.judgement.held_out_after = 0.25;
  report.judgement.condition = 12;
  report.judgement.coverage = 0.75;
  report.judgement.samples = 345;
  return report;
}

TEST(CalibrateJson, WithoutAnInstrumentEveryCalibratorSaysWhichOneIsLacking) {
  const CalibJson answer = answer_of({});
  for (const calib::Calibrator calibrator : calib::calibrators()) {
    const std::string name(calib::name_of(calibrator));
    ASSERT_TRUE(answer.contains(name)) << name;
    const CalibJson& one = answer[name];
    EXPECT_EQ(one["accepted"], false) << name;
    EXPECT_EQ(one["verdict"], "refused") << name;
    EXPECT_EQ(one["reason"],
              "the recording lacks an instrument: it takes " + std::string(calib::row_of(calibrator).needs_text));
    EXPECT_TRUE(one["held_out"].is_null()) << name;
    EXPECT_TRUE(one["condition"].is_null()) << name;
  }
  EXPECT_EQ(answer["swing"]["estimate"], CalibJson::object());
  EXPECT_EQ(answer["gyro"]["samples"], 0);
  EXPECT_TRUE(answer["gyro"]["scale"].is_null());
  EXPECT_TRUE(answer["magnetometer"]["matrix"].is_null());
  EXPECT_TRUE(answer["heading"]["after_rms_deg"].is_null()) << "nothing was judged";
}

TEST(CalibrateJson, WhatIsKnownHasItsValueItsErrorAndItsUnit) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  calib::Report report;
  auto magnetometer = judged(calib::Calibrator::magnetometer, calib::HeldOutQuantity::field);
  magnetometer.estimate = {{"offset_x_uT", 4, 0.5},
                           {"matrix_xz", 0.25, kInfinite},
                           {"worst_heading_rad", 0, 0.0625},
                           {"field_scale", 1.5, 0.125},
                           {"field_uT", 48, 1},
                           {"residual_uT", 0.75, 0}};
  auto swing = judged(calib::Calibrator::swing, calib::HeldOutQuantity::heading);
  swing.estimate = {{"deviation_rad", 0.5, 0.0625}};
  report.calibrators = {magnetometer, swing};
  report.heading = {7, 0.5, 0.25, 0.125};
  const CalibJson answer = answer_of(report);
  const CalibJson& field = answer["magnetometer"];
  EXPECT_EQ(field["field_scale"], 1.5);
  EXPECT_EQ(field["std"]["field_scale"], 0.125);
  EXPECT_EQ(field["std"]["offset_uT"], CalibJson::parse("[0.5,null,null]"));
  EXPECT_TRUE(field["std"]["matrix"][0][2].is_null()) << "an error that is not known";
  EXPECT_DOUBLE_EQ(field["std"]["worst_heading_deg"].get<double>(), 0.0625 * kRadian_deg);
  EXPECT_EQ(field["held_out"], CalibJson::parse(R"({"before":50,"after":25,"unit":"%"})"));
  EXPECT_EQ(field["condition"], 12);
  EXPECT_EQ(field["coverage"], 0.75);
  EXPECT_EQ(field["samples"], 345);
  EXPECT_DOUBLE_EQ(answer["swing"]["estimate"]["deviation_deg"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_DOUBLE_EQ(answer["swing"]["std"]["deviation_deg"].get<double>(), 0.0625 * kRadian_deg);
  EXPECT_DOUBLE_EQ(answer["swing"]["held_out"]["before"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_EQ(answer["swing"]["held_out"]["unit"], "deg");
  EXPECT_DOUBLE_EQ(answer["heading"]["before_rms_deg"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_DOUBLE_EQ(answer["heading"]["after_rms_deg"].get<double>(), 0.25 * kRadian_deg);
}

TEST(CalibLines, TheHeadingIsJudgedInDegreesOrNotAtAll) {
  calib::Report report;
  for (const char* const key : {"before_rms_deg", "after_rms_deg", "in_force_rms_deg"}) {
    const CalibJson line = CalibJson::parse(calib_lines(report, {}).at(0));
    ASSERT_TRUE(line["heading"].contains(key)) << key;
    EXPECT_TRUE(line["heading"][key].is_null()) << key;
  }
  report.heading = {7, 0.5, 0.25, 0.125};
  const CalibJson line = CalibJson::parse(calib_lines(report, {}).at(0));
  EXPECT_EQ(line["heading"]["blocks"], 7);
  EXPECT_DOUBLE_EQ(line["heading"]["before_rms_deg"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_DOUBLE_EQ(line["heading"]["after_rms_deg"].get<double>(), 0.25 * kRadian_deg);
  EXPECT_DOUBLE_EQ(line["heading"]["in_force_rms_deg"].get<double>(), 0.125 * kRadian_deg);
}

TEST(CalibLines, EveryStreamHasItsCounts) {
  calib::Report report;
  for (std::size_t s = 0; s < calib::kStreams; ++s) {
    report.gate.taken[s] = 10 + s;
    report.gate.gaps[s] = 20 + s;
    report.gate.left_out[s][s] = 30 + s;
  }
  const CalibJson line = CalibJson::parse(calib_lines(report, {}).at(0));
  for (std::size_t s = 0; s < calib::kStreams; ++s) {
    const CalibJson& stream = line["left_out"][std::string(calib::name_of(static_cast<calib::Stream>(s)))];
    EXPECT_EQ(stream["taken"], 10 + s);
    EXPECT_EQ(stream["gaps"], 20 + s);
    EXPECT_EQ(stream[std::string(calib::name_of(static_cast<calib::Rejection>(s)))], 30 + s);
    EXPECT_EQ(stream.size(), 3U) << "what was never left out is not named";
  }
}

TEST(CalibLines, ACalibratorHasItsVerdictAndItsEstimate) {
  auto gyro = judged(calib::Calibrator::gyro, calib::HeldOutQuantity::heading);
  gyro.verdict = calib::Verdict::shadow;
  gyro.outcome = calib::Outcome::no_better;
  gyro.estimate = {{"scale", 1.5, 0.25}, {"bias_rad_s", 0.5, 0.125}};
  gyro.held = true;
  gyro.steps_back = 2;
  calib::Report report;
  report.calibrators = {gyro};
  const CalibJson line = CalibJson::parse(calib_lines(report, {}).at(0));
  const CalibJson& one = line["calibrators"][0];
  EXPECT_EQ(one["verdict"], calib::name_of(gyro.verdict));
  EXPECT_EQ(one["judgement"], calib::name_of(gyro.outcome));
  EXPECT_EQ(one["estimate"]["scale"], 1.5);
  EXPECT_EQ(one["std"]["scale"], 0.25);
  EXPECT_DOUBLE_EQ(one["estimate"]["bias_deg_s"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_DOUBLE_EQ(one["held_out_before_deg"].get<double>(), 0.5 * kRadian_deg);
  EXPECT_TRUE(one["held_out_after_percent"].is_null());
  EXPECT_EQ(one["held"], true);
  EXPECT_EQ(one["steps_back"], 2);
}

TEST(CalibLines, AReportThatIsTooLongForALineComesInNumberedParts) {
  calib::Report report;
  for (const calib::Calibrator calibrator : calib::calibrators()) {
    auto one = judged(calibrator, calib::HeldOutQuantity::none);
    one.judgement.reason = std::string(3000, 'r');
    report.calibrators.push_back(one);
  }
  const auto lines = calib_lines(report, 1'790'000'000'000'000'000, R"("tcm2":{"a":1})");
  ASSERT_GT(lines.size(), 1U);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_LT(lines[i].size(), 10'000U) << "libgps reads no longer ones";
    const CalibJson line = CalibJson::parse(lines[i]);
    EXPECT_EQ(line["class"], "CALIB");
    EXPECT_EQ(line["part"], i + 1);
    EXPECT_EQ(line["parts"], lines.size());
    EXPECT_EQ(line["tcm2"]["a"], 1) << "what is common is in every part";
    for (const CalibJson& one : line["calibrators"]) names.push_back(one["calibrator"]);
  }
  ASSERT_EQ(names.size(), report.calibrators.size());
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(names[i], calib::name_of(report.calibrators[i].calibrator));
  report.calibrators.resize(1);
  const auto single = calib_lines(report, {});
  ASSERT_EQ(single.size(), 1U);
  EXPECT_FALSE(CalibJson::parse(single[0]).contains("part"));
}

}  // namespace
}  // namespace navcal::record
