// SPDX-License-Identifier: Apache-2.0
#include <navcal/simulate.h>

#include <limits>

#include "tests/api/api_program.h"

namespace navcal::api::test {
namespace {

class ApiSimulate : public ApiProgram {
 protected:
  [[nodiscard]] std::string content(const std::string& name) const {
    return navcal::test::read_file(folder_ / name);
  }
};

TEST_F(ApiSimulate, FilesAreThoseOfTheProgramByteForByte) {
  SimulateOptions options;
  options.mission = "survey";
  options.seconds = 20;
  options.effects = {{"motor_field", 1}, {"water_current", 0.3}};
  options.seed = 7;
  options.truth = folder_ / "a.csv";
  const Simulation simulation = simulate(folder_ / "a.cap", options);
  EXPECT_DOUBLE_EQ(simulation.duration_s, 20);
  (void)output_of(
      "simulate --mission survey --seconds 20 --effect motor_field=1 --effect water_current=0.3 --seed 7 "
      "-o b.cap --truth b.csv");
  ASSERT_GT(content("a.cap").size(), 10'000U);
  EXPECT_TRUE(content("a.cap") == content("b.cap"));
  EXPECT_TRUE(content("a.csv") == content("b.csv"));
}

TEST_F(ApiSimulate, PlaceDateClocksAndNoiseAreThoseOfTheProgram) {
  SimulateOptions options;
  options.mission = "survey";
  options.seconds = 5;
  options.place = Place{59.33, 18.07, 3.5};
  options.date = "2031-06-01";
  options.clocks = {{"compass", 0.99}};
  options.noise = false;
  const Simulation simulation = simulate(folder_ / "a.cap", options);
  ASSERT_EQ(simulation.remarks.size(), 1U) << "the model of the field ends before 2031";
  EXPECT_NE(simulation.remarks[0].find("World Magnetic Model"), std::string::npos);
  (void)output_of(
      "simulate --mission survey --seconds 5 --place 59.33,18.07,3.5 --date 2031-06-01 --clock compass=0.99 "
      "--no-noise -o b.cap");
  EXPECT_NE(navcal::test::read_file(folder_ / "err").find(simulation.remarks[0]), std::string::npos);
  EXPECT_TRUE(content("a.cap") == content("b.cap"));

  options.field_uT = {15, 2, 49};
  EXPECT_TRUE(simulate(folder_ / "c.cap", options).remarks.empty()) << "the model is not asked";
  EXPECT_NE(content("c.cap").find("north 15.000, east 2.000, down 49.000 uT"), std::string::npos);
}

TEST_F(ApiSimulate, ACancelledSimulationLeavesNoFile) {
  SimulateOptions options;
  options.mission = "survey";
  options.seconds = 60;
  options.truth = folder_ / "a.csv";
  options.progress = [](std::string_view step, double share) {
    EXPECT_EQ(step, "simulating");
    return share < 0.5;
  };
  const auto error = error_of([&] { simulate(folder_ / "a.cap", options); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, ErrorKind::cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(ApiSimulate, WhatCannotBeUsedIsNamed) {
  const auto refused = [&](const std::string& words, ErrorKind kind, auto change) {
    SimulateOptions options;
    options.mission = "survey";
    options.seconds = 1;
    change(options);
    const auto error = error_of([&] { simulate(folder_ / "a.cap", options); });
    ASSERT_TRUE(error) << words;
    EXPECT_EQ(error->kind, kind) << words;
    EXPECT_TRUE(error->names(words)) << error->message;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.cap")) << words;
  };
  const auto argument = ErrorKind::bad_argument, input = ErrorKind::bad_input;
  refused("one of", argument, [](auto& o) { o.mission.clear(); });
  refused("one of", argument, [](auto& o) { o.path = "x.csv"; });
  refused("no_such_mission", input, [](auto& o) { o.mission = "no_such_mission.toml"; });
  refused("warp_drive", argument, [](auto& o) { o.effects = {{"warp_drive", 1}}; });
  refused("finite", argument, [](auto& o) {
    o.effects = {{"water_current", std::numeric_limits<double>::quiet_NaN()}};
  });
  refused("missing.toml", input, [](auto& o) { o.effects_file = "/missing.toml"; });
  refused("missing.toml", input, [](auto& o) { o.vehicle = "/missing.toml"; });
  refused("missing.toml", input, [](auto& o) { o.config = "/missing.toml"; });
  refused("seconds", argument, [](auto& o) { o.seconds = -1; });
  refused("gps", argument, [](auto& o) { o.clocks = {{"gps", 1}}; });
  refused("rate", argument, [](auto& o) { o.clocks = {{"imu", 9}}; });
  refused("place", argument, [](auto& o) { o.place = Place{91, 0, 0}; });
  refused("field", argument, [](auto& o) { o.field_uT = {1000, 0, 0}; });
  refused("date", argument, [](auto& o) { o.date = "2026-02-30"; });
  refused("a.cap", argument, [&](auto& o) { o.truth = folder_ / "a.cap"; });
  refused("missing", ErrorKind::failed, [](auto& o) { o.truth = "/missing/folder/a.csv"; });
}

TEST_F(ApiSimulate, AnInputIsNotOverwritten) {
  (void)file("drive.csv", "t,x\n");
  SimulateOptions options;
  options.drive = folder_ / "drive.csv";
  const auto error = error_of([&] { simulate(folder_ / "drive.csv", options); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, ErrorKind::bad_argument);
  EXPECT_EQ(content("drive.csv"), "t,x\n");
}

}  // namespace
}  // namespace navcal::api::test
