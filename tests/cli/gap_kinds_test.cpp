// SPDX-License-Identifier: Apache-2.0
// The three answers behind "unknown", by the program: what is confounded, withheld, and too short.
#include <nlohmann/json.hpp>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class GapKinds : public test::ProgramInFolder {
 protected:
  /// A mission of constant shaft speed, so that the field of the motor's current is that of hard iron.
  void sail(const std::string& options) {
    write("one.toml", R"(
start.depth_m = 0.15
start.shaft_rpm = 780
step = [
  {do = "surface", seconds = 20},
  {do = "leg", heading_deg = 0, metres = 60},
  {do = "turn", by_deg = 90},
  {do = "leg", metres = 30},
  {do = "turn", by_deg = 90},
  {do = "leg", metres = 60},
]
)");
    ASSERT_EQ(run_navcal("simulate --mission ./one.toml --seed 7 " + options + " -o a.cap"), 0) << said("err");
  }
  nlohmann::json gap(const std::string& options = {}) {
    EXPECT_EQ(run_navcal("gap a.cap --bank 10 --cache bank --json a.json " + options), 0) << said("err");
    return nlohmann::json::parse(said("a.json"));
  }
};

TEST_F(GapKinds, ConfoundedCausesAreBothNamedWithTheManoeuvreThatDecides) {
  sail("--effect hard_iron=1");
  const auto json = gap("--report a.html");
  EXPECT_EQ(json["verdict"], "unknown");
  ASSERT_EQ(json["kind"], "ambiguous") << json["sentence"];
  ASSERT_EQ(json["alternatives"].size(), 2U);
  for (const auto& one : json["alternatives"]) {
    const std::string name = one["effects"][0]["name"];
    EXPECT_TRUE(name == "hard_iron" || name == "motor_field") << name;
    EXPECT_GT(one["closed"].get<double>(), 0.9);
    EXPECT_GT(one["probability"].get<double>(), 0.1);
  }
  EXPECT_NE(json["next"].dump().find("step the motor current on a constant heading"), std::string::npos);
  EXPECT_NE(said("out").find("Ambiguous: there is a gap"), std::string::npos) << said("out");
  EXPECT_NE(said("a.html").find("Ambiguous: there is a gap"), std::string::npos);
}

TEST_F(GapKinds, AWithheldCauseIsOutsideTheLibrary) {
  sail("--effect fin_offset=2");
  const auto json = gap("--exclude fin_offset --exclude fin_gain");
  EXPECT_EQ(json["verdict"], "unknown");
  EXPECT_EQ(json["kind"], "outside") << json["sentence"];
  EXPECT_TRUE(json["alternatives"].empty());
  EXPECT_NE(said("out").find("Outside the library: there is a gap"), std::string::npos) << said("out");
}

// A vehicle without a gap that waits: at the surface, where no simulated hull floats and few nulls tell little;
// and its mission alone, after it has waited under water.
TEST_F(GapKinds, WithoutSignificanceNoGapIsStated) {
  const auto sail_after_waiting = [&](const std::string& start) {
    write("wait.toml", start + R"(
start.shaft_rpm = 0
step = [
  {do = "surface", seconds = 400, shaft_rpm = 0},
  {do = "leg", heading_deg = 0, metres = 40, shaft_rpm = 780},
  {do = "turn", by_deg = 90},
  {do = "leg", metres = 40},
]
)");
    ASSERT_EQ(run_navcal("simulate --mission ./wait.toml --seed 1 -o a.cap"), 0) << said("err");
  };
  sail_after_waiting("");
  const auto waited = gap();
  EXPECT_NE(waited.value("kind", "cannot say"), "outside");
  EXPECT_NE(waited.value("kind", "cannot say"), "ambiguous");
  EXPECT_EQ(waited["sentence"].get<std::string>().find("there is a gap, and"), std::string::npos);
  sail_after_waiting("start.depth_m = 0.9");
  const auto moving = gap("--from 390");
  EXPECT_EQ(moving["verdict"], "no-gap") << moving["sentence"];
  EXPECT_LT(moving["duration_s"].get<double>(), waited["duration_s"].get<double>() - 200);
}

TEST_F(GapKinds, ARecordingThatCannotBeComparedCannotSay) {
  sail("--seconds 15");
  const auto json = gap();
  EXPECT_EQ(json["verdict"], "unknown");
  EXPECT_EQ(json["kind"], "cannot say");
}

}  // namespace
}  // namespace navcal::cli
