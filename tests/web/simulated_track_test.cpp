// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "web/page.h"

namespace navcal::web {
namespace {

class SimulatedTrack : public ::testing::Test {
 protected:
  std::filesystem::path write(std::string_view text) {
    std::ofstream(folder / "track.csv") << text;
    return folder / "track.csv";
  }
  std::string why(std::string_view text) {
    try {
      (void)read_simulated_track(write(text));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "(taken)";
  }
  navcal::test::TemporaryFolder folder;
};

TEST_F(SimulatedTrack, MetresOrDegreesByTheirColumns) {
  EXPECT_EQ(nlohmann::json::parse(read_simulated_track(write("t,x,y\n0,1,2\n1,-3,4.5\r\n"))),
            nlohmann::json::parse(R"({"unit":"m","points":[[1.0,2.0],[-3.0,4.5]]})"));
  EXPECT_EQ(nlohmann::json::parse(read_simulated_track(write("lon,lat\n18,59\n"))),
            nlohmann::json::parse(R"({"unit":"deg","points":[[59.0,18.0]]})"));
}

TEST_F(SimulatedTrack, HasABoundedNumberOfPoints) {
  std::string text = "x,y\n";
  for (int i = 0; i < 50'000; ++i) text += "1,2\n";
  const auto track = nlohmann::json::parse(read_simulated_track(write(text)));
  EXPECT_LE(track["points"].size(), 4000U);
  EXPECT_GT(track["points"].size(), 2000U);
}

TEST_F(SimulatedTrack, FileAndLineOfAMistake) {
  EXPECT_NE(why("x,y\n1,2\n1,east\n").find("track.csv line 3"), std::string::npos);
  EXPECT_NE(why("x,y\n1\n").find("line 2"), std::string::npos);
  EXPECT_NE(why("a,b\n1,2\n").find("line 1"), std::string::npos);
  EXPECT_NE(why("").find("empty"), std::string::npos);
}

}  // namespace
}  // namespace navcal::web
