// SPDX-License-Identifier: Apache-2.0
// navcal gap layouts: what it records, the programs of the same build read without a bad byte.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class GapLayouts : public test::ProgramInFolder {
 protected:
  static constexpr const char* kRecord = "gap layouts record --layout '" NAVCAL_SOURCE_DIR
                                         "/share/vehicles/bluerov2.toml' --vehicles 1 --nominal 1 "
                                         "--cases 2 --minutes 0.75 --seed 11 -o recordings --truth truth.jsonl";
};

TEST_F(GapLayouts, RecordingsAreDecodedWithoutABadByteAndScored) {
  ASSERT_EQ(run_navcal(kRecord), 0) << said("err");
  for (const char* const file : {"vehicle-1-nominal-1.cap", "0001-a.cap", "0002-c.cap"}) {
    for (const char* const port : {"compass", "imu", "gps", "doppler", "actuators"}) {
      const std::string described =
          std::string(port) == "actuators" ? "--device recordings/actuator-outputs.toml " : "";
      ASSERT_EQ(run_navcal("decode --json " + described + "--port " + port + " recordings/" + file), 0)
          << said("err");
      const std::string lines = said("out");
      const auto summary = nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
      EXPECT_EQ(summary.at("skipped_bytes").get<int>(), 0) << file << ' ' << port << ' ' << summary;
      EXPECT_EQ(summary.at("incomplete_bytes").get<int>(), 0) << file << ' ' << port << ' ' << summary;
      EXPECT_EQ(summary.at("bad_checksum").get<int>(), 0) << file << ' ' << port << ' ' << summary;
    }
  }
  ASSERT_EQ(run_navcal("replay --config recordings/navcald.toml recordings/0001-a.cap"), 0) << said("err");
  for (const char* const sample : {"\"output6\"", "\"DVL\"", "\"IMU\"", "\"COMPASS\"", "\"GPS\""})
    EXPECT_NE(said("out").find(sample), std::string::npos) << sample;

  EXPECT_EQ(said("recordings/cases.jsonl").find("effects"), std::string::npos);
  write("answers.jsonl", "{\"case\":\"0001\",\"verdict\":\"cannot-say\"}\n");
  ASSERT_EQ(run_navcal("gap layouts score answers.jsonl --truth truth.jsonl"), 0) << said("err");
  EXPECT_NE(said("out").find("1 of 2 cases answered"), std::string::npos) << said("out");
  ASSERT_EQ(run_navcal("gap layouts score answers.jsonl --truth truth.jsonl --json -"), 0) << said("err");
  EXPECT_EQ(nlohmann::json::parse(said("out")).at("cases"), 2);
}

// Three recordings of the same vehicle, as somebody makes them who tries the diagnosis for the first time.
TEST_F(GapLayouts, ANominalVehicleHasNoGap) {
  const std::string vehicle = " --vehicle '" NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml' ";
  for (const char* const seed : {"1", "2", "3"})
    ASSERT_EQ(
        run_navcal("simulate" + vehicle + "--mission survey --seconds 60 --seed " + seed + " -o " + seed + ".cap"),
        0)
        << said("err");
  ASSERT_EQ(run_navcal("gap" + vehicle + "--nominal 1.cap --nominal 2.cap 3.cap --json -"), 0) << said("err");
  const auto answer = nlohmann::json::parse(said("out"));
  EXPECT_EQ(answer.at("verdict"), "no-gap") << answer.at("sentence");
  EXPECT_TRUE(answer.at("effects").empty());
  EXPECT_FALSE(answer.at("least_visible").empty());
}

TEST_F(GapLayouts, TheSameSeedGivesTheSameFiles) {
  ASSERT_EQ(run_navcal(kRecord), 0) << said("err");
  const std::string first = said("recordings/0002-b.cap"), truth = said("truth.jsonl");
  std::filesystem::remove_all(folder_ / "recordings");
  ASSERT_EQ(run_navcal(kRecord), 0) << said("err");
  EXPECT_EQ(said("recordings/0002-b.cap"), first);
  EXPECT_EQ(said("truth.jsonl"), truth);
}

TEST_F(GapLayouts, WhatCannotBeIsSaid) {
  EXPECT_EQ(run_navcal("gap layouts record --layout '" NAVCAL_SOURCE_DIR
                       "/share/vehicles/slocum.toml' -o new --truth truth.jsonl"),
            3);
  EXPECT_NE(said("err").find("slocum.toml"), std::string::npos) << said("err");
  std::filesystem::create_directories(folder_ / "full/inside");
  EXPECT_EQ(run_navcal("gap layouts record --layout '" NAVCAL_SOURCE_DIR
                       "/share/vehicles/bluerov2.toml' -o full --truth truth.jsonl"),
            3);
  EXPECT_NE(said("err").find("not empty"), std::string::npos) << said("err");
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_EQ(run_navcal("gap layouts record --layout '" NAVCAL_SOURCE_DIR
                       "/share/vehicles/bluerov2.toml' -o empty --truth empty/truth.jsonl"),
            3);
  EXPECT_NE(said("err").find("must not lie"), std::string::npos) << said("err");
  EXPECT_EQ(run_navcal("gap layouts record --layout none.toml -o new --truth truth.jsonl"), 1);
  write("bad.jsonl", "{\n");
  EXPECT_EQ(run_navcal("gap layouts score bad.jsonl --truth bad.jsonl"), 3);
  EXPECT_NE(said("err").find("bad.jsonl: line 1"), std::string::npos) << said("err");
  EXPECT_EQ(run_navcal("gap layouts"), 2);
}

}  // namespace
}  // namespace navcal::cli
