// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command_outcome.h"
#include "tests/runs/four_thrusters.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;
using RunAnswer = nlohmann::json;

std::vector<RunAnswer> answers_in(const std::string& lines) {
  std::vector<RunAnswer> answers;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) answers.push_back(RunAnswer::parse(line));
  return answers;
}

class ValidateRunsCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "normal");
    fs::create_directory(folder_ / "runs");
    for (const auto& run : runs::test::nominal_runs(5, 6, 10)) write("normal/" + run.name + ".csv", run);
    runs::test::Trait heavy;
    heavy.weight_share = 0.4;
    int number = 0;
    for (const auto& run : runs::test::session_of(heavy, 10, 3))
      write(fmt::format("runs/r{:04}.csv", ++number), run);
  }
  void write(const std::string& name, const runs::Run& run) { write_text(name, runs::test::run_text(run)); }
  std::string write_text(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  test::Outcome ask(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"validate-runs", "--nominal", path("normal"), "--runs", path("runs"),
                                       "--json",        "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::run_command(add_validate_runs, std::move(arguments));
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(ValidateRunsCommand, AnswersEachRunAndPoolOnALine) {
  const auto pools =
      write_text("pools.json", R"({"p001":["r0001","r0002","r0003","r0004","r0005","r0006","r0007"]})");
  const auto outcome = ask({"--pools", pools});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto answers = answers_in(outcome.output);
  ASSERT_EQ(answers.size(), 11U);
  EXPECT_EQ(answers[0]["run"], "r0001");
  EXPECT_EQ(answers[9]["run"], "r0010");
  const RunAnswer& pool = answers[10];
  EXPECT_EQ(pool["pool"], "p001");
  EXPECT_EQ(pool["verdict"], "explained");
  ASSERT_EQ(pool["effects"].size(), 1U);
  EXPECT_EQ(pool["effects"][0]["name"], "AddWeight");
  EXPECT_GT(pool["effects"][0]["probability"], 0.8);
}

TEST_F(ValidateRunsCommand, WritesAFileAndSumsUp) {
  std::vector<std::string> arguments{"validate-runs",      "--nominal", path("normal"),        "--runs",
                                     path("runs"),         "--json",    path("answers.jsonl"), "--sessions",
                                     path("sessions.json")};
  const auto outcome = test::run_command(add_validate_runs, std::move(arguments));
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_EQ(answers_in(navcal::test::read_file(path("answers.jsonl"))).size(), 10U);
  EXPECT_NE(outcome.output.find("run: "), std::string::npos);
  std::size_t runs_in_sessions = 0;
  for (const auto& session : RunAnswer::parse(navcal::test::read_file(path("sessions.json")))) {
    runs_in_sessions += session.size();
  }
  EXPECT_EQ(runs_in_sessions, 30U);
}

TEST_F(ValidateRunsCommand, ARemovedEffectIsNotNamed) {
  const auto outcome = ask({"--removed", "AddWeight"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_EQ(outcome.output.find("AddWeight"), std::string::npos);
  const auto unknown = ask({"--removed", "Leak"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.message.find("PropellerDamage_bad"), std::string::npos);
}

TEST_F(ValidateRunsCommand, NamesFileLineAndColumnOfABadRun) {
  auto text = runs::test::run_text(runs::test::make_run({}, 1));
  text.replace(text.find("1100"), 4, "fast");
  write_text("runs/r0005.csv", text);
  const auto outcome = ask();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.message.find("r0005.csv:2: column pwm1: \"fast\" is not a number"), std::string::npos)
      << outcome.message;
}

TEST_F(ValidateRunsCommand, RefusesPoolsItCannotUse) {
  for (const auto& [text, what] :
       std::map<std::string, std::string>{{R"({"p001":["r0099"]})", "pool p001: there is no run r0099"},
                                          {R"({"p001":[]})", "pool p001 is not a list of runs"},
                                          {R"({"p001":[7]})", "pool p001: 7 is not the name of a run"},
                                          {R"(["r0001"])", "not an object of pools"},
                                          {R"({"p001":["r0001")", "not JSON"}}) {
    const auto outcome = ask({"--pools", write_text("pools.json", text)});
    EXPECT_EQ(outcome.status, 3) << text;
    EXPECT_NE(outcome.message.find(what), std::string::npos) << outcome.message;
  }
}

TEST_F(ValidateRunsCommand, RefusesFoldersWithoutRunsAndOtherVehicles) {
  fs::create_directory(folder_ / "none");
  const auto nothing = test::run_command(
      add_validate_runs, {"validate-runs", "--nominal", path("none"), "--runs", path("runs"), "--json", "-"});
  EXPECT_EQ(nothing.status, 3);
  EXPECT_NE(nothing.message.find("no run files"), std::string::npos) << nothing.message;
  runs::Run six = runs::test::make_run({}, 1);
  six.command_us.conservativeResize(Eigen::NoChange, 6);
  six.command_us.rightCols(2) = six.command_us.leftCols(2);
  auto text = runs::test::run_text(six);
  text.replace(text.find("pwm4"), 4, "pwm4,pwm5,pwm6");
  write_text("runs/r0011.csv", text);
  const auto other = ask();
  EXPECT_EQ(other.status, 3);
  EXPECT_NE(other.message.find("r0011 has 6 thrusters, the nominal vehicle 4"), std::string::npos)
      << other.message;
}

/// Real runs with known causes (Ji 2021), where they are at hand: the names of their pools, and no cause in pools
/// of normal runs that the nominal vehicle was not identified from.
class RunsOfJi : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path archive = fs::path(NAVCAL_SHARED_DIR) / "data/haizhe.tar.xz";
    std::error_code error;
    if (!fs::exists(archive, error)) GTEST_SKIP() << archive << " is not there";
    const std::string unpack = "tar -xJf " + archive.string() + " -C " + folder_.path().string() + " 2>/dev/null";
    if (std::system(unpack.c_str()) != 0) GTEST_SKIP() << "tar cannot unpack " << archive;
  }
  /// Answers about the pools of consecutive runs of a label, in the order of their file names.
  std::vector<RunAnswer> pools_of(const std::string& label) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "haizhe/" / label))
      names.push_back(entry.path().stem());
    std::ranges::sort(names);
    RunAnswer pools = RunAnswer::object();
    for (std::size_t i = 0; i + 10 <= names.size(); i += 10) {
      pools["p" + std::to_string(i)] = std::vector<std::string>(
          names.begin() + static_cast<std::ptrdiff_t>(i), names.begin() + static_cast<std::ptrdiff_t>(i + 10));
    }
    std::ofstream(folder_ / "pools.json") << pools;
    const auto outcome =
        test::run_command(add_validate_runs, {"validate-runs", "--nominal", (folder_ / "haizhe/Normal").string(),
                                              "--runs", (folder_ / "haizhe/" / label).string(), "--pools",
                                              (folder_ / "pools.json").string(), "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    auto answers = answers_in(outcome.output);
    std::erase_if(answers, [](const RunAnswer& answer) { return !answer.contains("pool"); });
    return answers;
  }
  static std::string name_in(const RunAnswer& answer) {
    return answer["effects"].empty() ? answer["verdict"].get<std::string>()
                                     : answer["effects"][0]["name"].get<std::string>();
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(RunsOfJi, WeightAndDepthSensorAreNamedInPools) {
  for (const std::string label : {"AddWeight", "PressureGain_constant"}) {
    for (const RunAnswer& answer : pools_of(label)) EXPECT_EQ(name_in(answer), label) << answer;
  }
}

TEST_F(RunsOfJi, PropellersAreNamedInPoolsOrNothingIsSaid) {
  for (const std::string label : {"PropellerDamage_bad", "PropellerDamage_slight"}) {
    for (const RunAnswer& answer : pools_of(label)) {
      const std::string name = name_in(answer);
      EXPECT_TRUE(name.starts_with("PropellerDamage") || name == "undecided") << answer;
    }
  }
}

}  // namespace
}  // namespace navcal::cli
