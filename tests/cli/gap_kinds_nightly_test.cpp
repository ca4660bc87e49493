// SPDX-License-Identifier: Apache-2.0
// The answers behind "unknown", by the program: what is withheld, and what waits.
#include "tests/cli/gap_kinds.h"

namespace navcal::cli {
namespace {

class GapKindsOfLongMissions : public test::GapKinds {};

TEST_F(GapKindsOfLongMissions, AWithheldCauseIsOutsideTheLibrary) {
  sail("--effect fin_offset=2");
  const auto json = gap("--exclude fin_offset --exclude fin_gain");
  EXPECT_EQ(json["verdict"], "unknown");
  EXPECT_EQ(json["kind"], "outside") << json["sentence"];
  EXPECT_TRUE(json["alternatives"].empty());
  EXPECT_NE(said("out").find("Outside the library: there is a gap"), std::string::npos) << said("out");
}

// A vehicle without a gap that waits: at the surface, where no simulated hull floats and few nulls tell little;
// and its mission alone, after it has waited under water.
TEST_F(GapKindsOfLongMissions, WithoutSignificanceNoGapIsStated) {
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

}  // namespace
}  // namespace navcal::cli
