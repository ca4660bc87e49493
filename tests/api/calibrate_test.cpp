// SPDX-License-Identifier: Apache-2.0
#include <navcal/calibrate.h>
#include <navcal/version.h>

#include <stdexcept>

#include "tests/api/api_program.h"

namespace navcal::api::test {
namespace {

using ApiCalibrate = ApiProgram;

TEST_F(ApiCalibrate, TheAnswerIsThatOfTheProgram) {
  const auto a = swing("a.cap", 200), b = swing("b.cap", 60, "--seed 2");
  const Calibration one = calibrate({a});
  EXPECT_EQ(one.json + "\n", output_of("calibrate --json a.cap"));
  EXPECT_NEAR(one.duration_s, 200, 1);
  EXPECT_TRUE(one.remarks.empty());
  const Calibration both = calibrate({a, b});
  EXPECT_EQ(both.json + "\n", output_of("calibrate --json a.cap b.cap"));
  EXPECT_NE(both.json, one.json);
}

TEST_F(ApiCalibrate, TypedMembersAreTheNumbersOfTheText) {
  const Calibration answer = calibrate({swing("a.cap", 200)});
  const auto json = nlohmann::json::parse(answer.json);
  const CalibratorResult* const gyro = answer.find("gyro");
  ASSERT_NE(gyro, nullptr);
  ASSERT_NE(gyro->quantity("scale"), nullptr);
  EXPECT_EQ(gyro->quantity("scale")->value, json["gyro"]["scale"].get<double>());
  EXPECT_EQ(gyro->quantity("scale")->std_error, json["gyro"]["scale_std"].get<double>());
  EXPECT_EQ(gyro->accepted, json["gyro"]["accepted"].get<bool>());
  EXPECT_EQ(gyro->samples, json["gyro"]["samples"].get<std::uint64_t>());
  EXPECT_EQ(gyro->quantity("no such quantity"), nullptr);
  EXPECT_EQ(answer.find("no such calibrator"), nullptr);
  for (const CalibratorResult& result : answer.calibrators) {
    ASSERT_TRUE(json.contains(result.name)) << result.name;
    EXPECT_TRUE(result.accepted || !result.reason.empty()) << result.name;
  }
  ASSERT_TRUE(answer.magnetometer);
  EXPECT_EQ(nlohmann::json(answer.magnetometer->offset_uT), json["magnetometer"]["offset_uT"]);
  EXPECT_EQ(nlohmann::json(answer.magnetometer->matrix), json["magnetometer"]["matrix"]);
  EXPECT_EQ(answer.heading.blocks, json["heading"]["blocks"].get<std::uint64_t>());
}

TEST_F(ApiCalibrate, ProgressRisesAndMayCancel) {
  const auto capture = swing("a.cap", 30);
  CalibrateOptions options;
  double newest = 0;
  int calls = 0;
  options.progress = [&](std::string_view step, double share) {
    EXPECT_EQ(step, capture.string());
    EXPECT_GE(share, newest);
    newest = share;
    ++calls;
    return true;
  };
  (void)calibrate({capture}, options);
  EXPECT_GT(calls, 100);
  EXPECT_DOUBLE_EQ(newest, 1);

  options.progress = [&](std::string_view, double share) { return share < 0.5; };
  const auto cancelled = error_of([&] { (void)calibrate({capture}, options); });
  ASSERT_TRUE(cancelled);
  EXPECT_EQ(cancelled->kind, ErrorKind::cancelled);
  EXPECT_TRUE(cancelled->names("cancelled"));

  struct MyOwn {};
  options.progress = [](std::string_view, double) -> bool { throw MyOwn{}; };
  EXPECT_THROW((void)calibrate({capture}, options), MyOwn) << "what the callback throws comes out unchanged";
}

TEST_F(ApiCalibrate, BadInputIsAnErrorThatNamesIt) {
  const auto none = error_of([] { (void)calibrate({}); });
  ASSERT_TRUE(none);
  EXPECT_EQ(none->kind, ErrorKind::bad_argument);
  const auto missing = error_of([&] { (void)calibrate({folder_ / "missing.cap"}); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->kind, ErrorKind::bad_input);
  EXPECT_TRUE(missing->names("missing.cap"));
  const auto garbage = error_of([&] { (void)calibrate({file("garbage.cap", "\x01\x02garbage")}); });
  ASSERT_TRUE(garbage);
  EXPECT_EQ(garbage->kind, ErrorKind::bad_input);
  EXPECT_TRUE(garbage->names("garbage.cap"));
  CalibrateOptions options;
  options.config = file("bad.toml", "[calibration]\nmargin = \"much\"\n");
  const auto config = error_of([&] { (void)calibrate({swing("a.cap", 1)}, options); });
  ASSERT_TRUE(config);
  EXPECT_EQ(config->kind, ErrorKind::bad_input);
  EXPECT_TRUE(config->names("bad.toml:2")) << config->message;
}

TEST_F(ApiCalibrate, ARecordingOfNothingHasAnAnswer) {
  const Calibration answer = calibrate({file("a.cap", "#capture 1\n#port imu imu-card 57600\n")});
  EXPECT_EQ(answer.json + "\n", output_of("calibrate --json a.cap"));
  EXPECT_EQ(answer.heading.blocks, 0U);
}

TEST_F(ApiCalibrate, TheVersionIsThatOfTheProgram) {
  EXPECT_EQ("navcal " + version() + "\n", output_of("--version"));
}

}  // namespace
}  // namespace navcal::api::test
