// SPDX-License-Identifier: Apache-2.0
// navcal gap trial --layout: what it records, the programs of the same build read without a bad byte, identify and
// diagnose.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "record/content_hash.h"
#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class GapTrialLayouts : public test::ProgramInFolder {
 protected:
  int run_trial(const std::string& layout, const std::string& more) {
    return run_navcal("gap trial --layout '" NAVCAL_SOURCE_DIR "/share/vehicles/" + layout +
                      ".toml' --vehicles 1 --nominal 1 --minutes 0.75 --seed 11 " + more);
  }
};

// A case without an effect: the search for one takes half a minute more.
TEST_F(GapTrialLayouts, AVehicleIsIdentifiedAndItsCaseIsAnswered) {
  ASSERT_EQ(run_trial("micro-auv", "--only 1 --keep kept --json trial.json --report trial.html"), 0)
      << said("err");
  const auto json = nlohmann::json::parse(said("trial.json"));
  EXPECT_EQ(json.at("layouts").at(0), "micro-auv.toml");
  ASSERT_EQ(json.at("cases").size(), 1U);
  for (const auto& one : json.at("cases")) {
    EXPECT_FALSE(one.contains("failure")) << one;
    EXPECT_NE(one.at("outcome"), "wrong name") << one.at("truth") << one.at("answer");
    EXPECT_EQ(one.at("sha256"),
              record::sha256_of(one.at("truth").get<std::string>() + one.at("salt").get<std::string>()));
    EXPECT_LT(said("out").find(one.at("sha256").get<std::string>()), said("out").find("answered in"));
  }
  EXPECT_EQ(json.at("cases").at(0).at("arm"), "nulls");
  EXPECT_NE(said("trial.html").find("1 vehicles by micro-auv.toml"), std::string::npos);
  EXPECT_NE(said("kept/vehicle-1/sheet.toml").find("force_scale_std = 0.05"), std::string::npos);

  const std::string ports = "kept/vehicle-1/";
  for (const char* const file : {"vehicle-1/nominal-1.cap", "0001/a.cap", "0001/c.cap"}) {
    for (const char* const port : {"compass", "imu", "gps", "doppler", "actuators"}) {
      const std::string described =
          std::string(port) == "actuators" ? "--device " + ports + "actuator-outputs.toml " : "";
      ASSERT_EQ(run_navcal("decode --json " + described + "--port " + port + " kept/" + file), 0) << said("err");
      const std::string lines = said("out");
      const auto summary = nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
      for (const char* const count : {"skipped_bytes", "incomplete_bytes", "bad_checksum"})
        EXPECT_EQ(summary.at(count).get<int>(), 0) << file << ' ' << port << ' ' << summary;
    }
  }
  ASSERT_EQ(run_navcal("replay --config " + ports + "navcald.toml kept/0001/a.cap"), 0) << said("err");
  for (const char* const sample : {"\"output4\"", "\"DVL\"", "\"IMU\"", "\"COMPASS\"", "\"GPS\""})
    EXPECT_NE(said("out").find(sample), std::string::npos) << sample;
}

// Three recordings of the same vehicle, as somebody makes them who tries the diagnosis for the first time.
TEST_F(GapTrialLayouts, ANominalVehicleHasNoGap) {
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

  ASSERT_EQ(run_navcal("gap --steady" + vehicle + "--nominal 1.cap --nominal 2.cap 3.cap"), 0) << said("err");
  EXPECT_NE(said("out").find("no gap"), std::string::npos) << said("out");
  EXPECT_NE(said("out").find("judged by mean forces over steady stretches alone"), std::string::npos)
      << said("out");
  ASSERT_EQ(run_navcal("gap --without gyros" + vehicle + "--nominal 1.cap --nominal 2.cap 3.cap"), 0)
      << said("err");
  EXPECT_NE(said("out").find("gyro_scale was not judged: the recording has no roll rate"), std::string::npos)
      << said("out");
}

// The program under trial is told names of files and no more; what it cannot do is no answer.
TEST_F(GapTrialLayouts, AVehicleThatIsNotIdentifiedHasNoAnswersAndTheSameRecordings) {
  write("program", "#!/bin/sh\necho \"$*\" >> '" + (folder_ / "told").string() + "'\necho no >&2\nexit 3\n");
  std::filesystem::permissions(folder_ / "program", std::filesystem::perms::owner_all);
  for (const std::string& kept : {std::string("one"), std::string("two")}) {
    ASSERT_EQ(run_trial("bluerov2", "--only 2 --program ./program --json trial.json --keep " + kept), 0)
        << said("err");
  }
  EXPECT_EQ(said("one/0002/b.cap"), said("two/0002/b.cap"));
  EXPECT_EQ(said("one/vehicle-1/nominal-1.cap"), said("two/vehicle-1/nominal-1.cap"));
  EXPECT_NE(said("trial.json").find("the vehicle is not identified: it ended with status 3: no"),
            std::string::npos);
  EXPECT_TRUE(said("told").starts_with("identify --no-advice /")) << said("told");
  EXPECT_EQ(said("told").find("gap "), std::string::npos) << said("told");
}

TEST_F(GapTrialLayouts, WhatCannotBeIsSaid) {
  EXPECT_EQ(run_trial("slocum", "--cases 1"), 3);
  EXPECT_NE(said("err").find("slocum.toml"), std::string::npos) << said("err");
  EXPECT_EQ(run_trial("bluerov2", "--cases 1 --active"), 2);
  EXPECT_NE(said("err").find("--active with --layout"), std::string::npos) << said("err");
  EXPECT_EQ(run_trial("bluerov2", "--cases 1 --bank 30"), 2);
  EXPECT_EQ(run_trial("bluerov2", "--cases 1 --arms triples"), 2);
  EXPECT_NE(said("err").find("there is no arm triples"), std::string::npos) << said("err");
  EXPECT_EQ(run_navcal("gap trial --cases 1 --minutes 5"), 2);
  EXPECT_EQ(run_navcal("gap trial --cases 1 --vehicles 3"), 2) << "it would not be obeyed";
  EXPECT_EQ(run_navcal("gap trial --layout none.toml --cases 1"), 3);
}

}  // namespace
}  // namespace navcal::cli
