// SPDX-License-Identifier: Apache-2.0
// navcal gap watch as a user runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class GapWatchProgram : public test::ProgramInFolder {
 protected:
  [[nodiscard]] std::vector<nlohmann::json> events() const {
    std::vector<nlohmann::json> all;
    std::istringstream lines(said("out"));
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
};

TEST_F(GapWatchProgram, RaisesTheAlarmAfterAChangeAndNotBefore) {
  std::ofstream(folder_ / "late.toml") << "[hard_iron]\nx_uT = 3\nfrom_s = 70\n";
  ASSERT_EQ(run_navcal("simulate --mission survey --seconds 160 --effects late.toml --seed 3 -o a.cap"), 0)
      << said("err");
  ASSERT_EQ(run_navcal("gap watch --recording a.cap --bank 12 --cache banks --state s.json --metrics m.prom"), 0)
      << said("err");
  const auto all = events();
  EXPECT_EQ(all.front().at("event"), "began");
  const auto& last = all.back();
  EXPECT_EQ(last.at("windows"), 4);
  EXPECT_NE(last.at("verdict"), "no_gap");
  EXPECT_GT(last.at("alarm").get<double>(), 1767225600.0 + 70);
  EXPECT_FALSE(last.at("where").empty());
  EXPECT_NE(said("m.prom").find("navcal_gap_watch_alarm 1"), std::string::npos);

  // The state holds over a restart, and the alarm comes once.
  ASSERT_EQ(run_navcal("gap watch --recording a.cap --bank 12 --cache banks --state s.json"), 0) << said("err");
  EXPECT_EQ(events().front().at("restored_windows"), 4);
  for (const auto& event : events()) EXPECT_NE(event.at("event"), "alarm");
}

TEST_F(GapWatchProgram, WatchesALayoutWithNominalRecordings) {
  const std::string vehicle =
      std::string(" --vehicle ") + NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml ";
  for (const std::string number : {"1", "2"})
    ASSERT_EQ(run_navcal("simulate" + vehicle + "--mission calibration_swing --seconds 80 --seed " + number +
                         " -o n" + number + ".cap"),
              0)
        << said("err");
  std::ofstream(folder_ / "late.toml") << "[thrust_scale]\nof = \"thruster.2\"\nscale = -0.3\nfrom_s = 66\n";
  ASSERT_EQ(
      run_navcal("simulate" + vehicle + "--mission survey --seconds 130 --effects late.toml --seed 3 -o a.cap"), 0)
      << said("err");
  const std::string watch =
      "gap watch" + vehicle + "--nominal n1.cap --nominal n2.cap --recording a.cap --state s.json";
  ASSERT_EQ(run_navcal(watch), 0) << said("err");
  const auto all = events();
  EXPECT_EQ(all.front().at("event"), "began");
  EXPECT_EQ(all.front().at("reference").at("missions"), 2);
  const auto& last = all.back();
  EXPECT_EQ(last.at("windows"), 4);
  EXPECT_NEAR(last.at("alarm").get<double>(), 1767225600.0 + 94, 1);
  // At one speed an offset of its command says the same as a part of its thrust.
  const std::string name = last.at("effects").at(0).at("name");
  EXPECT_TRUE(name == "thrust_scale of thruster.2" || name == "thruster_offset of thruster.2") << name;
  EXPECT_EQ(last.at("where").at(0).at("regime"), "newest window");

  ASSERT_EQ(run_navcal(watch), 0) << said("err");
  EXPECT_EQ(events().front().at("restored_windows"), 4);
  EXPECT_EQ(run_navcal("gap watch" + vehicle + "--recording a.cap"), 2);
  EXPECT_NE(said("err").find("--nominal"), std::string::npos) << said("err");
}

TEST_F(GapWatchProgram, SaysWhatIsWrong) {
  std::ofstream(folder_ / "x.cap") << "nothing\n";
  std::ofstream(folder_ / "v.toml") << "[hull]\nmas_kg = 3\n";
  EXPECT_EQ(run_navcal("gap watch --recording x.cap"), 3) << said("err");
  EXPECT_EQ(run_navcal("gap watch --recording x.cap --vehicle v.toml"), 3) << said("err");
  EXPECT_EQ(run_navcal("gap watch --recording x.cap --state x.cap"), 2) << "an input is never overwritten";
  EXPECT_EQ(run_navcal("gap watch --port 1 --seconds 8"), 1) << said("err");
  EXPECT_NE(said("err").find("no connection"), std::string::npos) << said("err");
}

}  // namespace
}  // namespace navcal::cli
