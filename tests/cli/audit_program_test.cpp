// SPDX-License-Identifier: Apache-2.0
// The audit of recordings with and without planted errors, by the program.
#include <nlohmann/json.hpp>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class AuditProgram : public test::ProgramInFolder {
 protected:
  nlohmann::json audit(const std::string& arguments) {
    EXPECT_EQ(run_navcal("audit --json - " + arguments), 0) << said("err");
    return nlohmann::json::parse(said("out"));
  }
  static const nlohmann::json* find(const nlohmann::json& answer, const std::string& name) {
    for (const auto& finding : answer.at("findings")) {
      if (finding.at("name") == name && finding.at("certainty") == "found") return &finding;
    }
    return nullptr;
  }
};

TEST_F(AuditProgram, FindsWhatWasPlantedAndNothingElse) {
  ASSERT_EQ(run_navcal("simulate --mission identification --seed 2 -o right.cap"), 0) << said("err");
  write("planted.toml", "[hard_iron]\nx_uT = 4\ny_uT = 3\nz_uT = 0\n[gyro_scale]\nscale_az = 0.05\n");
  ASSERT_EQ(run_navcal("simulate --mission identification --seed 2 --effects planted.toml -o wrong.cap"), 0)
      << said("err");

  const auto right = audit("right.cap");
  for (const auto& finding : right.at("findings")) {
    // Every simulated gyro has a bias from its power-on.
    const std::string name = finding.at("name");
    EXPECT_TRUE(finding.at("certainty") == "cannot say" || name == "gyro.bias" || name == "gyro.rest") << finding;
  }
  const auto wrong = audit("wrong.cap --report page.html");
  const auto* const iron = find(wrong, "compass.iron");
  ASSERT_NE(iron, nullptr) << wrong;
  // 5 uT across a horizontal field of 19 uT.
  EXPECT_NEAR(iron->at("value"), 15.2, 3);
  EXPECT_LT(iron->at("low"), iron->at("high"));
  EXPECT_GT(iron->at("cost").at("heading_deg"), 10);
  EXPECT_GT(iron->at("cost").at("position_m_10min"), 0);
  EXPECT_EQ(iron->at("channel"), "compass");
  EXPECT_EQ(iron->at("unit"), "deg");
  EXPECT_NE(iron->at("todo"), "");
  const auto* const scale = find(wrong, "gyro.scale");
  ASSERT_NE(scale, nullptr) << wrong;
  EXPECT_NEAR(scale->at("value"), 1 / 1.05, 0.005);
  EXPECT_FALSE(wrong.at("nothing_found"));
  EXPECT_NE(said("page.html").find("Iron at the compass"), std::string::npos);

  const auto both = audit("right.cap wrong.cap");
  bool changed = false;
  for (const auto& change : both.at("changes")) changed = changed || change.at("name") == "compass.iron";
  EXPECT_TRUE(changed) << both.at("changes");
}

TEST_F(AuditProgram, TheFieldOfTheMotorIsNoIron) {
  write("motor.toml", "[motor_field]\nx_uT_per_A = 1.6\ny_uT_per_A = 1.2\nz_uT_per_A = 0\n");
  ASSERT_EQ(run_navcal("simulate --mission identification --seed 3 --effects motor.toml -o motor.cap"), 0)
      << said("err");
  const auto answer = audit("motor.cap");
  const auto* const motor = find(answer, "compass.motor");
  ASSERT_NE(motor, nullptr) << answer;
  EXPECT_LT(motor->at("low"), 2);
  EXPECT_GT(motor->at("high"), 2);
  EXPECT_EQ(find(answer, "compass.iron"), nullptr) << answer;  // its steady part is the same cause
}

TEST_F(AuditProgram, SaysWhatCannotBeSaid) {
  ASSERT_EQ(run_navcal("simulate --mission survey --seconds 20 -o short.cap"), 0) << said("err");
  const auto answer = audit("short.cap");
  EXPECT_EQ(find(answer, "compass.iron"), nullptr);
  bool said_so = false;
  for (const auto& finding : answer.at("findings"))
    said_so = said_so || (finding.at("name") == "compass.iron" && finding.at("certainty") == "cannot say");
  EXPECT_TRUE(said_so) << answer;
  EXPECT_TRUE(answer.at("nothing_found"));
}

TEST_F(AuditProgram, ABadFileEndsWithItsPlace) {
  write("bad.BIN", "no log at all");
  EXPECT_EQ(run_navcal("audit bad.BIN"), 3);
  EXPECT_NE(said("err").find("bad.BIN"), std::string::npos) << said("err");
  EXPECT_EQ(run_navcal("audit --report bad.BIN bad.BIN"), 2);
}

}  // namespace
}  // namespace navcal::cli
