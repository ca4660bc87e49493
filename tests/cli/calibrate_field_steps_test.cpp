// SPDX-License-Identifier: Apache-2.0
// Steps of the field, through the programs that people run.
#include <array>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

class FieldSteps : public CalibrateProgram {
 protected:
  /// Level turns for a minute, then the hull rolls and pitches: the usual procedure.
  void write_level_first_tilt_later() const {
    write_path("level_first.csv", 150, [](double t_s) {
      const double sway = t_s < 60 ? 0 : 0.5 - 0.5 * std::cos(0.6 * (t_s - 60));
      return Angles{0.35 * sway * std::sin(0.17 * t_s), 0.45 * sway * std::cos(0.11 * t_s), 0.25 * t_s};
    });
  }
  /// Turns with roll and pitch.
  void write_turns(double duration_s) const {
    write_path("turns.csv", duration_s, [](double t_s) {
      return Angles{0.3 * std::sin(0.41 * t_s), 0.3 * std::sin(0.27 * t_s), 0.23 * t_s};
    });
  }
};

TEST_F(FieldSteps, AHullThatTiltsForTheFirstTimeIsNoStep) {
  write_level_first_tilt_later();
  write("soft.toml",
        "[soft_iron]\nxx = 0.1\nyy = -0.06\nxz = 0.05\n[hard_iron]\nx_uT = 3\ny_uT = -2\nz_uT = 14\n");
  for (const std::string effects : {"", "--effects soft.toml "}) {
    for (const char* seed : {"1", "2", "3"}) {
      output_of("simulate --path level_first.csv " + effects + "--seed " + seed + " -o a.cap");
      const auto json = calibrated("a.cap");
      EXPECT_EQ(json["steps"].size(), 0U) << effects << seed << json["steps"];
      ASSERT_EQ(json["segments"].size(), 1U);
      EXPECT_GT(json["segments"][0]["readings"], 1450);
      EXPECT_LT(json["segments"][0]["spread_calibrated"], 0.012) << effects << seed;
    }
  }
}

TEST_F(FieldSteps, AMagnetPutOnAndTakenOffIsToldWithTimesAndSizes) {
  write_turns(180);
  write("magnet.toml", "[hard_iron]\nx_uT = -1.5\ny_uT = -0.5\nz_uT = -13.6\nfrom_s = 60\nuntil_s = 120\n");
  output_of("simulate --path turns.csv --effects magnet.toml --seed 5 -o a.cap");
  const auto json = calibrated("a.cap");
  const auto& steps = json["steps"];
  ASSERT_EQ(steps.size(), 2U) << steps;
  constexpr double kBegin_s = 1'767'225'600;  // 2026-01-01
  const std::array<double, 3> size_uT{-1.5, -0.5, -13.6};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(steps[i]["time"].get<double>(), kBegin_s + 60 + 60 * static_cast<double>(i), 0.5);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double std_uT = steps[i]["std_uT"][axis];
      EXPECT_LT(std_uT, 0.4);
      EXPECT_NEAR(steps[i]["size_uT"][axis].get<double>(), (i == 0 ? 1 : -1) * size_uT[axis], 4 * std_uT) << i;
    }
  }
  ASSERT_EQ(json["segments"].size(), 3U);
  for (const auto& segment : json["segments"]) {
    EXPECT_GT(segment["readings"], 550);
    EXPECT_LT(segment["spread_calibrated"], 0.01) << segment;
    EXPECT_GT(segment["to"], segment["from"]);
  }
  EXPECT_GT(json["segments"][1]["spread_raw"], 0.03);
  const std::string text = output_of("calibrate --report page.html a.cap");
  const std::string page = navcal::test::read_file(folder_ / "page.html");
  for (const char* said : {"the field stepped by (-1.", "at 2026-01-01T00:01:00.", "back to the field before",
                           "readings, spread of the field's size"}) {
    EXPECT_NE(text.find(said), std::string::npos) << said << '\n' << text;
    EXPECT_NE(page.find(said), std::string::npos) << said;
  }
}

TEST_F(FieldSteps, ARecordingWithoutAStepSaysNothingOfSteps) {
  write_turns(60);
  output_of("simulate --path turns.csv --seed 6 -o a.cap");
  EXPECT_EQ(calibrated("a.cap")["steps"].size(), 0U);
  EXPECT_EQ(output_of("calibrate a.cap").find("stepped"), std::string::npos);
}

}  // namespace
}  // namespace navcal::cli::test
