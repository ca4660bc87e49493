// SPDX-License-Identifier: Apache-2.0
// Missions at places of the Earth: the diagnosis finds the field by itself, from the fixes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

class GapPlaces : public testing::TestWithParam<const char*> {
 protected:
  void run(const std::string& arguments) const {
    const std::string command = NAVCAL_PROGRAM " " + arguments + " 2>" + (folder_ / "errors").string();
    ASSERT_EQ(std::system(command.c_str()), 0) << navcal::test::read_file(folder_ / "errors");
  }
  /// A mission whose recording does not tell of its field.
  void simulate(const std::string& options, int seconds = 140) const {
    run(fmt::format("simulate --mission identification --seconds {} ", seconds) + options + " -o " +
        (folder_ / "made.cap").string());
    std::ifstream made(folder_ / "made.cap");
    std::ofstream silent(folder_ / "a.cap");
    for (std::string line; std::getline(made, line);) {
      if (!line.starts_with("#event")) silent << line << '\n';
    }
  }
  [[nodiscard]] nlohmann::json gap(const std::string& options = {}) const {
    const std::string json = (folder_ / "a.json").string();
    run("gap " + (folder_ / "a.cap").string() + " --bank 20 --cache " + folder_.path().string() + " " + options +
        " --json " + json + " >/dev/null");
    return nlohmann::json::parse(navcal::test::read_file(json));
  }
  navcal::test::TemporaryFolder folder_;
};

TEST_P(GapPlaces, NominalIsNoGapAndIronIsNamed) {
  const std::string where = std::string("--place=") + GetParam() + " --date 2027-05-01";
  simulate(where + " --seed 3");
  const auto nominal = gap();
  EXPECT_EQ(nominal["verdict"], "no-gap") << nominal["sentence"];
  EXPECT_EQ(nominal["field"]["source"], "model");
  EXPECT_EQ(nominal["field"]["date"], "2027-05-01");
  EXPECT_EQ(nominal["effects"].size(), 0U);

  std::ofstream(folder_ / "iron.toml") << "[hard_iron]\nx_uT = 1.6\ny_uT = -1.2\n";
  simulate(where + " --seed 4 --effects " + (folder_ / "iron.toml").string());
  const auto iron = gap();
  EXPECT_EQ(iron["verdict"], "explained") << iron["sentence"];
  ASSERT_EQ(iron["effects"].size(), 1U) << iron["sentence"];
  EXPECT_EQ(iron["effects"][0]["name"], "hard_iron");
}

INSTANTIATE_TEST_SUITE_P(FarApart, GapPlaces, testing::Values("78.22,15.63", "-0.74,-90.31", "-54.8,179.999"));

using GapField = GapPlaces;

// A recording so short allows no other statement.
TEST_F(GapField, IsTheGivenOneBeforeTheStatedBeforeTheModels) {
  simulate("--seed 3 --place 59.33,18.07 --field 10,20,30", 20);
  EXPECT_EQ(gap()["field"]["source"], "model");
  EXPECT_NEAR(gap()["field"]["place"]["latitude_deg"], 59.33, 0.01);
  std::filesystem::rename(folder_ / "made.cap", folder_ / "a.cap");
  EXPECT_EQ(gap()["field"]["source"], "stated");
  EXPECT_EQ(gap()["field"]["north_east_down_uT"], nlohmann::json::array({10, 20, 30}));
  const auto given = gap("--field 19.0,0.6,44.0");
  EXPECT_EQ(given["field"]["source"], "given");
  EXPECT_EQ(given["field"]["north_east_down_uT"], nlohmann::json::array({19.0, 0.6, 44.0}));
}

}  // namespace
}  // namespace navcal::cli
