// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/live/commands.h"
#include "record/content_hash.h"
#include "tests/cli/command_outcome.h"
#include "tests/report/markup.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

// The whole trial with a shell script for a diagnosing program.
namespace navcal::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoGap =
    R"({"verdict":"no-gap","where":[],"effects":[],"gap":{"closed":null,"closed_ci":null},"unexplained":[]})";
constexpr const char* kFinLag =
    R"({"verdict":"explained","where":[{"channel":"vehicle.yaw_rate"}],)"
    R"("effects":[{"name":"fin_lag","probability":0.9}],"gap":{"closed":1.0,"closed_ci":[0.9,1.1]}})";

/// Gone, or waiting for its parent to notice.
bool is_dead(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return !(file >> number >> name >> state) || state == "Z";
}

class GapTrial : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder_ / "temporary");
    ::setenv("TMPDIR", (folder_ / "temporary").c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("TMPDIR");
    EXPECT_TRUE(fs::is_empty(folder_ / "temporary"));
  }

  /// `shell` finds the name of the answer's file in $json.
  void stub(const std::string& shell) const {
    std::ofstream(folder_ / "stub") << "#!/bin/sh\nall=\"$*\"\nwhile [ $# -gt 0 ]; do\n"
                                       "  [ \"$1\" = --json ] && json=$2\n  shift\ndone\ncd '"
                                    << folder_.path().string() << "'\n"
                                    << shell << '\n';
    fs::permissions(folder_ / "stub", fs::perms::owner_all);
  }
  void stub_says(const std::string& json) const { stub("cat > \"$json\" <<'END'\n" + json + "\nEND"); }

  [[nodiscard]] test::Outcome run(std::vector<std::string> arguments) const {
    std::vector<std::string> all{
        "trial",    "--minutes",           "3", "--program", folder_ / "stub", "--json", folder_ / "trial.json",
        "--report", folder_ / "trial.html"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return test::run_command(add_gap_trial, all);
  }
  [[nodiscard]] nlohmann::json result() const {
    return nlohmann::json::parse(navcal::test::read_file(folder_ / "trial.json"));
  }
  [[nodiscard]] double score(const std::string& name, const char* key) const {
    const nlohmann::json whole = result();
    for (const auto& one : whole["scores"]) {
      if (one["name"] == name) return one[key].get<double>();
    }
    ADD_FAILURE() << name;
    return -1;
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(GapTrial, TheDiagnosisIsToldNamesOfFilesAndNoMore) {
  stub(
      "echo \"$all\" >> told; head -n 2 \"$(dirname \"$json\")/a.cap\" >> told; ls \"$(dirname \"$json\")\" >> "
      "told\n" +
      std::string("cat > \"$json\" <<'END'\n") + kNoGap + "\nEND");
  ASSERT_EQ(run({"--arms", "removed", "--cases", "1", "--seed", "987654", "--bank", "30"}).status, 0);
  const auto json = result();
  const std::string told = navcal::test::read_file(folder_ / "told");
  const auto truth = nlohmann::json::parse(json["cases"][0]["truth"].get<std::string>());
  const std::string excluded = truth["excluded"];
  EXPECT_TRUE(told.starts_with("gap ")) << told;
  for (const std::string& part :
       {std::string("/a.cap --holdout "), std::string("/b.cap --holdout "), std::string("/c.cap --vehicle "),
        std::string(" --bank 30 --exclude ") + excluded}) {
    EXPECT_NE(told.find(part), std::string::npos) << part << " in " << told;
  }
  EXPECT_NE(told.find("\na.cap\nb.cap\nc.cap\nerrors.txt\nvehicle.toml\n"), std::string::npos) << told;
  for (const char* secret : {"987654", "removed", "trial"})
    EXPECT_EQ(told.find(secret), std::string::npos) << told;
}

TEST_F(GapTrial, WhatIsPublishedFirstIsTheDigestOfWhatIsToldLast) {
  stub_says(kFinLag);
  const auto outcome = run({"--only", "1,2,3", "--seed", "5", "--jobs", "2"});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const nlohmann::json json = result();
  ASSERT_EQ(json["cases"].size(), 3U);
  for (const auto& one : json["cases"]) {
    const std::string digest = one["sha256"];
    EXPECT_EQ(record::sha256_of(one["truth"].get<std::string>() + one["salt"].get<std::string>()), digest);
    EXPECT_LT(outcome.output.find(digest), outcome.output.find("answered in"));
    EXPECT_EQ(outcome.output.find(one["salt"].get<std::string>()), std::string::npos);
  }
  EXPECT_EQ(score("nulls: an effect named", "value"), 1);
}

TEST_F(GapTrial, ThePageIsWholeAndNamesTheMistakes) {
  stub_says(kFinLag);
  ASSERT_EQ(run({"--arms", "nulls,single-1,pairs", "--cases", "3", "--seed", "5"}).status, 0);
  const std::string page = navcal::test::read_file(folder_ / "trial.html");
  EXPECT_EQ(test::flaw_in(page), "");
  for (const char* part : {"nulls: flagged", "Confusion matrix", "Power", "Calibration", "Mistakes", "--only CASE",
                           "explained: fin_lag (0.9)", "Seals", "prefers-color-scheme: dark"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(GapTrial, ADiagnosisThatFailsIsCountedWithItsReason) {
  struct Failing {
    const char* shell;
    const char* said;
  };
  for (const auto& [shell, said] :
       std::vector<Failing>{{"echo noise >&2; echo 'navcal: a.cap:7: bad line' >&2; exit 3",
                             "ended with status 3: navcal: a.cap:7"},
                            {"kill -SEGV $$", "ended by signal 11 (Segmentation fault)"},
                            {"exit 0", "wrote no answer"},
                            {"echo '{\"verdict\":' > \"$json\"", "malformed"},
                            {"sleep 60", "no answer within 1 s"}}) {
    stub(shell);
    ASSERT_EQ(run({"--only", "1", "--timeout", "1"}).status, 0) << shell;
    const std::string failure = result()["cases"][0]["failure"];
    EXPECT_NE(failure.find(said), std::string::npos) << failure;
    EXPECT_EQ(score("no answer", "hits"), 1);
    EXPECT_EQ(test::flaw_in(navcal::test::read_file(folder_ / "trial.html")), "");
  }
}

TEST_F(GapTrial, AProgramThatIsNotThereIsAFailureToo) {
  ASSERT_EQ(run({"--only", "1"}).status, 0);
  const std::string failure = result()["cases"][0]["failure"];
  EXPECT_NE(failure.find("No such file"), std::string::npos) << failure;
}

TEST_F(GapTrial, InterruptedItEndsTheDiagnosisAndScoresWhatThereIs) {
  stub("if [ -e once ]; then trap '' TERM; sleep 60 & echo $! > pid; kill -INT $PPID; wait; fi\ntouch once\n" +
       std::string("cat > \"$json\" <<'END'\n") + kNoGap + "\nEND");
  const auto outcome = run({"--arms", "nulls", "--cases", "3"});
  EXPECT_EQ(outcome.status, static_cast<int>(base::Exit::failed));
  EXPECT_NE(outcome.message.find("interrupted: 1 of 3 cases are scored"), std::string::npos) << outcome.message;
  EXPECT_EQ(result()["cases"].size(), 1U);
  EXPECT_EQ(result()["ended_early"], "interrupted");
  int pid = 0;
  std::ifstream(folder_ / "pid") >> pid;
  ASSERT_GT(pid, 0);
  EXPECT_TRUE(navcal::test::eventually([&] { return is_dead(pid); }));
}

TEST_F(GapTrial, KeepsRecordingsWithTheirTruthWhenAskedTo) {
  stub_says(kNoGap);
  ASSERT_EQ(run({"--only", "4", "--keep", folder_ / "kept"}).status, 0);
  for (const char* name : {"a.cap", "b.cap", "c.cap", "answer.json", "truth.json"})
    EXPECT_GT(fs::file_size(folder_ / "kept" / "0004" / name), 10U) << name;
}

TEST_F(GapTrial, TheSameSeedGivesTheSameRecordings) {
  stub_says(kNoGap);
  for (const char* name : {"one", "two"}) ASSERT_EQ(run({"--only", "2", "--keep", folder_ / name}).status, 0);
  for (const char* name : {"a.cap", "b.cap", "c.cap"}) {
    EXPECT_EQ(navcal::test::read_file(folder_ / "one" / "0002" / name),
              navcal::test::read_file(folder_ / "two" / "0002" / name));
  }
}

TEST_F(GapTrial, WrongUsageIsRefusedBeforeAnythingIsDrawn) {
  stub_says(kNoGap);
  for (const auto& [arguments, said] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{}, "either --cases N or --only CASE"},
           {{"--cases", "1", "--only", "2"}, "either --cases N or --only CASE"},
           {{"--cases", "1", "--arms", "doubles"}, "there is no arm doubles"},
           {{"--cases", "0"}, "--cases"},
           {{"--only", "-3"}, "--only"}}) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.status, static_cast<int>(base::Exit::usage)) << said;
    EXPECT_NE(outcome.message.find(said), std::string::npos) << outcome.message;
  }
  EXPECT_FALSE(fs::exists(folder_ / "trial.json"));
}

}  // namespace
}  // namespace navcal::cli
