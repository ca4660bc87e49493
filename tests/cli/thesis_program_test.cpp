// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class ThesisProgram : public testing::Test {
 protected:
  struct Outcome {
    int status = -1;
    std::string out, err;
  };
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] Outcome run(std::vector<std::string> arguments,
                            const std::string& program = NAVCAL_PROGRAM) const {
    arguments.insert(arguments.begin(), {program, "thesis"});
    navcal::test::Process process(arguments, folder_ / "run");
    const auto status = process.wait(240s);
    return {status.value_or(-1), process.out(), process.err()};
  }
  void expect_refused(const std::vector<std::string>& arguments, int status, const std::string& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(ThesisProgram, WritesPageAndJson) {
  const Outcome outcome = run({"--runs", "2", "--report", at("t.html"), "--json", at("t.json")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const auto json = nlohmann::json::parse(navcal::test::read_file(folder_ / "t.json"));
  EXPECT_EQ(json["class"], "THESIS");
  EXPECT_EQ(json["runs"], 2);
  EXPECT_EQ(json["seed"], 1);
  EXPECT_NE(navcal::test::read_file(folder_ / "t.html").find("Figure 4.12: "), std::string::npos);
  // The same seed gives the same numbers.
  const Outcome again = run({"--runs", "2", "--json", "-"});
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.out, navcal::test::read_file(folder_ / "t.json"));
}

TEST_F(ThesisProgram, WrongUsageIsRefusedBeforeTheWork) {
  expect_refused({}, 2, "--report FILE.html or --json FILE");
  expect_refused({"--report", at("t.html"), "--runs", "1"}, 2, "--runs");
  expect_refused({"--report", at("t.html"), "--runs", "many"}, 2, "--runs");
  expect_refused({"--report", at("t.html"), "--seed", "-1"}, 2, "--seed");
  expect_refused({"--report", at("t.html"), "--json", at("t.html")}, 2, "two outputs have this name");
  expect_refused({"--report", at("missing/t.html")}, 1, "missing/t.html");
  EXPECT_FALSE(fs::exists(at("t.html")));
}

TEST_F(ThesisProgram, MissingPathsAreTold) {
  expect_refused({"--report", at("t.html"), "--paths", at("nowhere")}, 3, at("nowhere") + "/path1.csv");
  EXPECT_FALSE(fs::exists(at("t.html")));
}

TEST_F(ThesisProgram, AnInputIsNotWrittenOver) {
  fs::copy(NAVCAL_SOURCE_DIR "/fixtures/paths", at("paths"));
  expect_refused({"--paths", at("paths"), "--report", at("paths/path3.csv")}, 2, "both input and output");
}

TEST_F(ThesisProgram, FindsThePathsWhereTheyAreInstalled) {
  fs::create_directories(folder_ / "bin");
  fs::copy_file(NAVCAL_PROGRAM, folder_ / "bin/navcal");
  const Outcome without = run({"--runs", "2", "--report", at("t.html")}, at("bin/navcal"));
  EXPECT_EQ(without.status, 1);
  EXPECT_NE(without.err.find("the paths of the thesis (path1.csv to path8.csv) are missing in " +
                             fs::canonical(folder_.path()).string() + "/share/navcal/thesis"),
            std::string::npos)
      << without.err;
  fs::create_directories(folder_ / "share/navcal");
  fs::create_directory_symlink(NAVCAL_SOURCE_DIR "/fixtures/paths", folder_ / "share/navcal/thesis");
  const Outcome with = run({"--runs", "2", "--report", at("t.html")}, at("bin/navcal"));
  EXPECT_EQ(with.status, 0) << with.err;
  EXPECT_TRUE(fs::exists(at("t.html")));
}

TEST_F(ThesisProgram, AnInterruptLeavesNoHalfPage) {
  std::ofstream(folder_ / "t.html") << "old";
  navcal::test::Process process(
      {NAVCAL_PROGRAM, "thesis", "--runs", "100000", "--report", at("t.html"), "--json", at("t.json")},
      folder_ / "run");
  EXPECT_FALSE(process.wait(1s)) << process.err();
  process.signal(SIGINT);
  EXPECT_EQ(process.wait(60s), 128 + SIGINT);
  EXPECT_EQ(navcal::test::read_file(folder_ / "t.html"), "old");
  EXPECT_FALSE(fs::exists(at("t.json")));
}

}  // namespace
}  // namespace navcal::cli
