// SPDX-License-Identifier: Apache-2.0
// The command around the diagnosis, which is made up here.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/live/commands.h"
#include "config/layout/layout_file.h"
#include "gap/verdict/request.h"
#include "gap/verdict/study.h"
#include "report/gap_report.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/cli/command_outcome.h"
#include "tests/report/gap_samples.h"
#include "tests/support/temporary_folder.h"

namespace {

std::optional<navcal::gap::Request> asked;

}  // namespace

namespace navcal::gap {

Diagnosis diagnose(const Request& request, const Progress& progress) {
  asked = request;
  progress("bank", 0.5);
  if (request.missions.front() == "bad.cap") throw record::BadRecording("bad.cap:3: no number");
  return cli::test::explained_gap();
}

std::unique_ptr<Study> study(const Request& request, const Progress& progress) {
  auto result = std::make_unique<Study>(request);
  result->diagnosis = diagnose(request, progress);
  return result;
}

}  // namespace navcal::gap

namespace navcal::cli {

void add_gap_trial(CLI::App& gap) {
  gap.add_subcommand("trial", "")->callback([] { std::fputs("trial", stdout); });
}

}  // namespace navcal::cli

namespace navcal::cli::test {
namespace {

class GapCommand : public testing::Test {
 protected:
  GapCommand() { asked.reset(); }
  static Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "gap");
    return run_command(add_gap, std::move(arguments));
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(GapCommand, TakesSeveralRecordings) {
  ASSERT_EQ(run({"a.cap", "b.cap", "--holdout", "c.cap"}).status, 0);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->missions, (std::vector<std::filesystem::path>{"a.cap", "b.cap"}));
  EXPECT_EQ(asked->holdouts, std::vector<std::filesystem::path>{"c.cap"});
}

TEST_F(GapCommand, AsksForWhatWasSaid) {
  const Outcome outcome = run({"--holdout", "b.cap", "--exclude", "hard_iron", "a.cap", "--holdout", "c.cap",
                               "--exclude", "gyro_scale", "--bank", "30", "--seed", "7", "--cache", "here"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->missions.front(), "a.cap");
  EXPECT_EQ(asked->holdouts, (std::vector<std::filesystem::path>{"b.cap", "c.cap"}));
  EXPECT_EQ(asked->excluded, (std::vector<std::string>{"hard_iron", "gyro_scale"}));
  EXPECT_EQ(asked->bank_missions, 30);
  EXPECT_EQ(asked->bank_seed, 7U);
  EXPECT_EQ(asked->cache, "here");
  EXPECT_FALSE(asked->field_uT);
  EXPECT_EQ(outcome.output.find("explained"), 0U);
}

TEST_F(GapCommand, AFieldGoesIntoTheRequest) {
  EXPECT_EQ(run({"a.cap", "--field", "19.0,0.6,-44.0"}).status, 0);
  ASSERT_TRUE(asked && asked->field_uT);
  EXPECT_EQ(*asked->field_uT, (gap::Vector3{19, 0.6, -44}));
  EXPECT_EQ(run({"a.cap", "--field", "19.0,0.6"}).status, 2);
}

TEST_F(GapCommand, InstrumentsAreLeftOutByName) {
  EXPECT_EQ(run({"a.cap", "--without", "gps", "--without", "depth"}).status, 0);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->without, (std::vector<gap::Quantity>{gap::Quantity::fixes, gap::Quantity::depth}));
  asked.reset();
  const Outcome unknown = run({"a.cap", "--without", "sonar"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.message.find("--without: there is no instrument sonar; there are compass, field"),
            std::string::npos)
      << unknown.message;
  EXPECT_FALSE(asked);
}

TEST_F(GapCommand, ItsCacheIsWhereCachesAre) {
  ::setenv("HOME", "/home/someone", 1);
  ::setenv("XDG_CACHE_HOME", "/caches", 1);
  run({"a.cap"});
  EXPECT_EQ(asked->cache, "/caches/navcal");
  ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
  run({"a.cap"});
  EXPECT_EQ(asked->cache, "/home/someone/.cache/navcal");
  ::unsetenv("XDG_CACHE_HOME");
  ::unsetenv("HOME");
  run({"a.cap"});
  EXPECT_EQ(asked->cache, "");
}

TEST_F(GapCommand, WritesWhatIsWanted) {
  const auto file = [&](const char* name) { return (folder_ / name).string(); };
  const Outcome outcome =
      run({"a.cap", "--json", file("a.json"), "--report", file("a.html"), "--effects-out", file("a.toml")});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_EQ(nlohmann::json::parse(navcal::test::read_file(file("a.json")))["verdict"], "explained");
  EXPECT_NE(navcal::test::read_file(file("a.html")).find("</html>"), std::string::npos);
  EXPECT_NE(navcal::test::read_file(file("a.toml")).find("[motor_field]"), std::string::npos);
  EXPECT_EQ(outcome.output.find("explained"), 0U) << "text comes with it";
}

TEST_F(GapCommand, JsonOnStandardOutputIsAlone) {
  const Outcome outcome = run({"a.cap", "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["verdict"], "explained");
}

TEST_F(GapCommand, WrongUsageIsToldBeforeTheWork) {
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"--bank", "9", "a.cap"}).status, 2);
  const Outcome unknown = run({"--exclude", "motorfield", "a.cap"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.message.find("did you mean motor_field"), std::string::npos) << unknown.message;
  EXPECT_EQ(run({"--report", (folder_ / "absent" / "a.html").string(), "a.cap"}).status, 1);
  EXPECT_FALSE(asked);
}

TEST_F(GapCommand, BadInputNamesFileAndPlace) {
  const Outcome recording = run({"bad.cap"});
  EXPECT_EQ(recording.status, 3);
  EXPECT_EQ(recording.message, "bad.cap:3: no number");
  const auto vehicle = (folder_ / "vehicle.toml").string();
  std::ofstream(vehicle) << "nothing.like_this = 1\n";
  const Outcome outcome = run({"--vehicle", vehicle, "a.cap"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.message.find(vehicle + ":1"), 0U) << outcome.message;
}

/// A saved diagnosis and what is exported from it.
class GapExportCommand : public GapCommand {
 protected:
  GapExportCommand() {
    std::ofstream(folder_ / "a.json") << report::gap_json(explained_gap());
    std::ofstream(folder_ / "config.toml") << "[port.imu]\nprotocol = \"imu-card\"\npath = \"/dev/null\"\n";
  }
  [[nodiscard]] std::string at(const char* name) const { return (folder_ / name).string(); }
  [[nodiscard]] Outcome exported(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--from", at("a.json")});
    ::testing::internal::CaptureStderr();
    Outcome outcome = run(std::move(arguments));
    outcome.message += ::testing::internal::GetCapturedStderr();
    return outcome;
  }
};

TEST_F(GapExportCommand, ASavedDiagnosisGivesTheFiles) {
  const Outcome outcome = exported({"--export", "sitl=" + at("a.parm"), "--export", "stonefish=" + at("a.xml"),
                                    "--export", "holoocean=" + at("h.json"), "--effects-out", at("a.toml")});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_FALSE(asked);
  EXPECT_EQ(outcome.output, "");
  EXPECT_NE(navcal::test::read_file(at("a.parm")).find("SIM_MAG_MOT_X 8.031"), std::string::npos);
  EXPECT_NE(navcal::test::read_file(at("a.xml")).find("<scenario>"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(navcal::test::read_file(at("h.json")))["agents"][0]["agent_type"], "TorpedoAUV");
  EXPECT_NE(navcal::test::read_file(at("a.toml")).find("[motor_field]"), std::string::npos);
  EXPECT_NE(outcome.message.find(at("a.parm") + ": motor_field, gyro_scale"), std::string::npos)
      << outcome.message;
  EXPECT_NE(outcome.message.find("left out: motor_field (the compass gives a heading"), std::string::npos);
}

TEST_F(GapExportCommand, ARecordingIsDiagnosedAndExportedBesideItsAnswer) {
  const Outcome outcome =
      run({"a.cap", "--config", at("config.toml"), "--json", "-", "--export", "sitl=" + at("a.parm")});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_TRUE(asked);
  EXPECT_EQ(nlohmann::json::parse(outcome.output)["verdict"], "explained");
  EXPECT_NE(navcal::test::read_file(at("a.parm")).find("Diagnosis of a.cap"), std::string::npos);
}

TEST_F(GapExportCommand, AFileThatExistsStays) {
  std::ofstream(folder_ / "a.parm") << "mine";
  const Outcome refused = exported({"--export", "sitl=" + at("a.parm")});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.message.find(at("a.parm") + ": the file exists and is not overwritten"), std::string::npos)
      << refused.message;
  EXPECT_EQ(navcal::test::read_file(at("a.parm")), "mine");
  EXPECT_EQ(run({"a.cap", "--export", "sitl=" + at("a.parm")}).status, 1);
  EXPECT_FALSE(asked) << "before the work";
  EXPECT_EQ(exported({"--overwrite", "--export", "sitl=" + at("a.parm")}).status, 0);
  EXPECT_NE(navcal::test::read_file(at("a.parm")), "mine");
  EXPECT_EQ(exported({"--overwrite", "--export", "sitl=" + at("a.json")}).status, 2) << "its own input";
}

TEST_F(GapExportCommand, ALayoutIsCorrectedAndNothingElseIsMadeOfIt) {
  std::ofstream(folder_ / "a.json")
      << R"({"verdict": "explained", "effects": [{"name": "thrust_scale", "of": "thruster.2",
      "probability": 1, "parameters": {"scale": -0.2}, "std_errors": {"scale": 0.01}}]})";
  const std::filesystem::path shipped = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  std::filesystem::copy_file(shipped, folder_ / "auv.toml");
  const Outcome outcome = exported({"--vehicle", at("auv.toml"), "--export", "layout=" + at("c.toml")});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_NE(outcome.message.find(at("c.toml") + ": thrust_scale of thruster.2"), std::string::npos);
  const sim::LayoutEffect weak{sim::find_layout_effect("thrust_scale"), "thruster.2", {-0.2}};
  EXPECT_EQ(config::layout_file(config::load_layout(folder_ / "c.toml")),
            config::layout_file(sim::changed_layout(config::load_layout(shipped), weak)));
  EXPECT_EQ(exported({"--vehicle", at("auv.toml"), "--export", "layout=" + at("c.toml")}).status, 1);
  EXPECT_EQ(exported({"--vehicle", at("auv.toml"), "--overwrite", "--export", "layout=" + at("auv.toml")}).status,
            2);
  EXPECT_EQ(navcal::test::read_file(at("auv.toml")), navcal::test::read_file(shipped)) << "its own input";
  EXPECT_EQ(exported({"--vehicle", at("auv.toml"), "--export", "sitl=" + at("x")}).status, 2);
  EXPECT_EQ(exported({"--export", "layout=" + at("x")}).status, 2);
}

TEST_F(GapExportCommand, WrongUsageIsSaid) {
  EXPECT_NE(exported({"--export", "gazebo"})
                .message.find("there is no simulator gazebo; known are sitl, holoocean, "
                              "stonefish, layout"),
            std::string::npos);
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"--export", "gazebo"},
                                             {"--export", "sitl="},
                                             {"--export", "sitl=-"},
                                             {"a.cap", "--export", "sitl=" + at("x")},
                                             {"--json", "-", "--export", "sitl=" + at("x")},
                                             {"--holdout", "b.cap", "--export", "sitl=" + at("x")},
                                             {"--export", "sitl=" + at("x"), "--export", "stonefish=" + at("x")}})
    EXPECT_EQ(exported(arguments).status, 2);
  EXPECT_EQ(exported({"--export", "sitl=" + at("absent") + "/x"}).status, 1);
}

TEST_F(GapExportCommand, ABadFileIsNamed) {
  std::ofstream(folder_ / "a.json") << "{\"verdict\": \"explained\",\n \"effects\": [{}]}";
  const Outcome bad = exported({"--export", "sitl=" + at("x")});
  EXPECT_EQ(bad.status, 3);
  EXPECT_EQ(bad.message, at("a.json") + ": effects[0]: the key name is missing");
  EXPECT_FALSE(std::filesystem::exists(at("x")));
  EXPECT_EQ(run({"--from", at("absent.json"), "--export", "sitl=" + at("x")}).status, 3);
  std::filesystem::remove(at("a.json"));
  std::filesystem::create_directory(at("a.json"));
  EXPECT_EQ(exported({"--export", "sitl=" + at("x")}).status, 3);
}

TEST_F(GapCommand, ARecordingMayBeNamedLikeTheTrial) {
  EXPECT_EQ(run({"trial"}).output, "trial");
  EXPECT_FALSE(asked);
  run({"./trial"});
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->missions.front(), "./trial");
}

}  // namespace
}  // namespace navcal::cli::test
