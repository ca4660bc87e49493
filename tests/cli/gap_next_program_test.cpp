// SPDX-License-Identifier: Apache-2.0
// navcal gap next as a user runs it: what it writes, the simulator sails.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class GapNextProgram : public test::ProgramInFolder {};

TEST_F(GapNextProgram, PlansAMissionThatTheSimulatorSails) {
  std::ofstream(folder_ / "limits.toml") << "[limits]\nminutes = 1.5\nmax_depth_m = 2\nenergy_Wh = 5\n";
  ASSERT_EQ(run_navcal("simulate --mission survey --seconds 80 --effect yaw_damping=0.3 --seed 3 -o a.cap"), 0)
      << said("err");
  const std::string next = "gap next a.cap --bank 12 --cache banks --limits limits.toml --mission-out next.toml ";
  ASSERT_EQ(run_navcal(next + "--json next.json --report next.html"), 0) << said("err");
  const auto plan = nlohmann::json::parse(said("next.json"));
  EXPECT_EQ(plan.at("mission"), "next.toml");
  EXPECT_LE(plan.at("minutes").get<double>(), 1.51);
  EXPECT_TRUE(plan.at("decides").is_boolean());
  EXPECT_GE(plan.at("probability_exact").get<double>(), 0);
  EXPECT_FALSE(plan.at("sentence").get<std::string>().empty());
  for (const auto& pair : plan.at("pairs")) {
    EXPECT_TRUE(pair.at("a").is_array() && pair.at("b").is_array());
    EXPECT_GE(pair.at("separation_nats").get<double>(), 0);
  }
  EXPECT_NE(said("next.html").find("</html>"), std::string::npos);
  EXPECT_EQ(run_navcal("simulate --mission ./next.toml --seconds 60 --seed 4 -o b.cap"), 0) << said("err");
  EXPECT_EQ(run_navcal("gap a.cap b.cap --bank 12 --cache banks --json -"), 0) << said("err");

  EXPECT_EQ(run_navcal(next), 2) << "the mission file is there already";
  EXPECT_EQ(run_navcal(next + "--overwrite"), 0) << said("err");
}

TEST_F(GapNextProgram, PlansForAVehicleWithALayoutWhoseSecondRecordingAgrees) {
  const std::string vehicle = " --vehicle " NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml ";
  std::ofstream(folder_ / "weak.toml") << "[thrust_scale]\nof = \"thruster.1\"\nscale = -0.3\n";
  for (const char* options : {"survey --seconds 40 --seed 1 -o n1.cap", "survey --seconds 40 --seed 2 -o n2.cap",
                              "survey --seconds 30 --seed 3 --effects weak.toml -o a.cap"})
    ASSERT_EQ(run_navcal("simulate" + vehicle + "--mission " + options), 0) << said("err");
  const std::string nominals = vehicle + "--nominal n1.cap --nominal n2.cap ";
  ASSERT_EQ(run_navcal("gap next a.cap" + nominals + "--minutes 1 --mission-out next.toml --json next.json"), 0)
      << said("err");
  const auto plan = nlohmann::json::parse(said("next.json"));
  EXPECT_TRUE(plan.at("extremes").at("shaft_rpm").is_null()) << "there is no motor card";
  EXPECT_FALSE(plan.at("manoeuvres").empty());
  EXPECT_LE(plan.at("minutes").get<double>(), 1.01);
  ASSERT_EQ(run_navcal("simulate" + vehicle +
                       "--mission ./next.toml --seconds 60 --seed 4 --effects weak.toml -o b.cap"),
            0)
      << said("err");
  ASSERT_EQ(run_navcal("gap a.cap b.cap" + nominals + "--json after.json"), 0) << said("err");
  const auto after = nlohmann::json::parse(said("after.json"));
  EXPECT_EQ(after.at("verdict"), "explained") << after.at("sentence");
  ASSERT_EQ(after.at("effects").size(), 1U) << after.at("sentence");
  EXPECT_EQ(after.at("effects")[0].at("name"), "thrust_scale");
  EXPECT_EQ(after.at("effects")[0].at("of"), "thruster.1");
  EXPECT_FALSE(after.at("differences")[0].at("differs").get<bool>());
}

TEST_F(GapNextProgram, SaysWhatIsWrong) {
  std::ofstream(folder_ / "bad.toml") << "[limits]\nminuts = 3\n";
  std::ofstream(folder_ / "x.cap") << "nothing\n";
  EXPECT_EQ(run_navcal("gap next x.cap --limits bad.toml --mission-out n.toml"), 3);
  EXPECT_NE(said("err").find("bad.toml:2: limits.minuts"), std::string::npos) << said("err");
  EXPECT_EQ(run_navcal("gap next x.cap --mission-out n.toml"), 3);
  EXPECT_EQ(run_navcal("gap next x.cap --mission-out x.cap --overwrite"), 2) << "an input is never overwritten";
  EXPECT_EQ(run_navcal("gap next x.cap"), 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "n.toml"));
}

}  // namespace
}  // namespace navcal::cli
