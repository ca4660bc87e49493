// SPDX-License-Identifier: Apache-2.0
// The answers behind "unknown", by the program: what is confounded, and what is too short.
#include "tests/cli/gap_kinds.h"

namespace navcal::cli {
namespace {

class GapKinds : public test::GapKinds {};

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

// It ended by a read of a vector that nobody had filled.
TEST_F(GapKinds, ConfoundedCausesAreNamedOnAHoldOutToo) {
  write("iron.toml", "[hard_iron]\nx_uT = -1.7\ny_uT = -0.9\n");
  sail("--effects iron.toml");
  ASSERT_EQ(run_navcal("simulate --mission ./one.toml --seed 8 --effects iron.toml -o b.cap"), 0) << said("err");
  const auto json = gap("--holdout b.cap");
  ASSERT_EQ(json["kind"], "ambiguous") << json["sentence"];
  for (const auto& one : json["alternatives"]) EXPECT_GT(one["closed"].get<double>(), 0.9);
}

TEST_F(GapKinds, ARecordingThatCannotBeComparedCannotSay) {
  sail("--seconds 15");
  const auto json = gap();
  EXPECT_EQ(json["verdict"], "unknown");
  EXPECT_EQ(json["kind"], "cannot say");
}

}  // namespace
}  // namespace navcal::cli
