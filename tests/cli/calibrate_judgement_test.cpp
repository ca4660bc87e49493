// SPDX-License-Identifier: Apache-2.0
// What `navcal calibrate` says an estimate is worth.
#include <nlohmann/json.hpp>

#include "tests/cli/calibrate_command.h"
#include "tests/cli/simulated_recording.h"

namespace navcal::cli::test {
namespace {

using Json = nlohmann::json;

class CalibrateJudgement : public CalibrateCommand {
 protected:
  Json calibrated(const std::vector<sim::PathRow>& path, const RecordingOptions& options) {
    const Outcome outcome = run({"--json", write("a.cap", simulated_recording(path, options))});
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    return Json::parse(outcome.output, nullptr, false);
  }
};

RecordingOptions compass_only() {
  RecordingOptions options;
  options.duration_s = 200;
  options.imu = options.gps = options.motor = false;
  return options;
}

TEST_F(CalibrateJudgement, WithoutAGyroTheFieldItselfIsTheJudge) {
  RecordingOptions options = compass_only();
  options.offset_uT = {6, -4, 2};
  const Json magnetometer = calibrated(turning_path(200), options)["magnetometer"];
  EXPECT_EQ(magnetometer["judgement"], "accepted") << magnetometer;
  EXPECT_EQ(magnetometer["held_out"]["unit"], "%");
  EXPECT_LT(magnetometer["held_out"]["after"], magnetometer["held_out"]["before"].get<double>() / 3);
  EXPECT_EQ(magnetometer["verdict"], "in_force") << "a vehicle with nothing but a compass is helped, too";
}

TEST_F(CalibrateJudgement, ACompassThatIsRightIsNotReplaced) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RecordingOptions options = compass_only();
    options.seed = seed;
    const Json magnetometer = calibrated(turning_path(200), options)["magnetometer"];
    EXPECT_NE(magnetometer["verdict"], "in_force") << magnetometer;
  }
}

TEST_F(CalibrateJudgement, WhatIsNoBetterHeldOutIsSaidToBeSo) {
  RecordingOptions options;
  options.duration_s = 400;
  const Json json = calibrated(turning_path(400), options);
  for (const char* const name : {"gyro", "compass", "magnetometer"}) {
    const Json& one = json[name];
    if (one["judgement"] == "refused" || one["held_out"].is_null()) continue;
    const bool worse = one["held_out"]["after"] >= one["held_out"]["before"];
    EXPECT_EQ(one["judgement"] == "no better", worse) << name << one;
    if (worse) {
      EXPECT_FALSE(one["reason"].get<std::string>().empty()) << name;
    }
  }
}

TEST_F(CalibrateJudgement, WhatIsNotDeterminedIsNull) {
  RecordingOptions options;
  const Json json = calibrated(straight_path(60), options);
  EXPECT_EQ(json["gyro"]["judgement"], "refused");
  for (const char* const coefficient : {"B", "C", "D", "E"}) {
    const Json& value = json["compass"]["deviation_deg"][coefficient];
    const Json& error = json["compass"]["deviation_std_deg"][coefficient];
    EXPECT_EQ(value.is_null(), error.is_null()) << coefficient;
    if (!error.is_null()) {
      EXPECT_LT(error, 180) << coefficient;
    }
  }
  const Json& scale = json["gyro"]["scale_std"];
  EXPECT_TRUE(scale.is_null() || scale < 1) << scale;
}

TEST_F(CalibrateJudgement, AMissingInstrumentIsNamed) {
  const Json json = calibrated(turning_path(60), compass_only());
  EXPECT_EQ(json["gyro"]["reason"], "no reading of the inertial card so far");
  EXPECT_EQ(json["gps_compass"]["reason"], "no fix with a speed over ground so far");
}

}  // namespace
}  // namespace navcal::cli::test
