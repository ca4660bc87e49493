// SPDX-License-Identifier: Apache-2.0
// Words of the compass with an error code, through the programs that people run.
#include <filesystem>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

class ErrorCodes : public CalibrateProgram {};

/// Iron so strong that the emulated compass remarks it in nearly every word.
TEST_F(ErrorCodes, ACompassThatReportsDistortionBecauseOfItsIronIsCalibrated) {
  write("iron.toml", "[hard_iron]\nx_uT = 16\ny_uT = -9\nz_uT = 18\n");
  write_path("turns.csv", 120, [](double t_s) {
    return Angles{0.45 * std::sin(0.3 * t_s), 0.4 * std::sin(0.19 * t_s), 0.2 * t_s};
  });
  output_of("simulate --path turns.csv --effects iron.toml --seed 3 -o a.cap");
  const auto json = calibrated("a.cap");
  const auto& compass = json["left_out"]["compass"];
  EXPECT_GT(compass["distorted"], 900) << compass;
  EXPECT_FALSE(compass.contains("faulty")) << compass;
  const auto& magnetometer = json["magnetometer"];
  EXPECT_TRUE(magnetometer["accepted"]) << magnetometer;
  EXPECT_GT(magnetometer["samples"], 1000);
  EXPECT_NEAR(magnetometer["offset_uT"][0], 16, 0.5);
  EXPECT_NEAR(magnetometer["offset_uT"][1], -9, 0.5);
  EXPECT_NE(output_of("calibrate a.cap").find("with E001: the compass reports magnetic distortion"),
            std::string::npos);
}

/// A hull that is turned over: beyond 50 degrees of tilt the emulated inclinometer gives up (E002).
TEST_F(ErrorCodes, TheFieldOfWordsWithoutTiltIsUsed) {
  write("iron.toml", "[hard_iron]\nx_uT = 6\ny_uT = -4\nz_uT = 9\n[soft_iron]\nxx = 0.08\nxy = 0.03\n");
  write_path("tumbling.csv", 120, [](double t_s) {
    return Angles{0.5 * t_s, 0.9 * std::sin(0.21 * t_s), 0.17 * t_s};
  });
  output_of("simulate --path tumbling.csv --effects iron.toml --seed 4 -o a.cap");
  const auto json = calibrated("a.cap");
  const auto& compass = json["left_out"]["compass"];
  EXPECT_GT(compass["tilt_out_of_range"], 600) << compass;
  const auto& magnetometer = json["magnetometer"];
  EXPECT_TRUE(magnetometer["accepted"]) << magnetometer;
  EXPECT_GT(magnetometer["samples"].get<double>(), 0.98 * compass["taken"].get<double>()) << magnetometer;
  EXPECT_NEAR(magnetometer["offset_uT"][0], 6, 0.1);
  EXPECT_NEAR(magnetometer["offset_uT"][1], -4, 0.1);
  EXPECT_NEAR(magnetometer["offset_uT"][2], 9, 0.1);
}

/// A board that was turned through the whole sphere: two words in three carry E002.
TEST_F(ErrorCodes, TheSphereOfARealBoardReachesThePublishedSpread) {
  const std::string recording = NAVCAL_SHARED_DIR "/data/hmc_sphere.cap";
  if (!std::filesystem::exists(recording)) GTEST_SKIP() << "../shared is missing";
  const auto json = calibrated(recording);
  EXPECT_GT(json["magnetometer"]["samples"], 1040) << json["magnetometer"];
  output_of("calibrate --report page.html " + recording);
  const std::string page = navcal::test::read_file(folder_ / "page.html");
  const std::string before = " % as measured, ";
  const auto at = page.find(before);
  ASSERT_NE(at, std::string::npos);
  EXPECT_LE(std::stod(page.substr(at + before.size())), 0.42);
}

}  // namespace
}  // namespace navcal::cli::test
