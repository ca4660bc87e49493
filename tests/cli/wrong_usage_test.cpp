// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

// Command lines that would destroy something or that cannot be meant, given to the program as people give them.
namespace navcal::cli {
namespace {

class WrongUsage : public testing::Test {
 protected:
  struct Outcome {
    int status = 0;
    std::string errors;
  };
  /// Runs `navcal ARGUMENTS` in the test's folder.
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' " + arguments + " > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, navcal::test::read_file(folder_ / "err")};
  }
  void expect_refused(const std::string& arguments, int status, const std::string& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << '\n' << outcome.errors;
    EXPECT_NE(outcome.errors.find(words), std::string::npos) << arguments << '\n' << outcome.errors;
  }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(WrongUsage, NoOutputIsWrittenOverAnInput) {
  ASSERT_EQ(run("simulate --mission survey --seconds 5 -o a.cap").status, 0);
  ASSERT_EQ(run("log import -o a.mcap a.cap").status, 0);
  std::filesystem::create_symlink(folder_ / "a.cap", folder_ / "link.cap");
  std::filesystem::create_hard_link(folder_ / "a.cap", folder_ / "part.cap.part");
  const std::string capture = navcal::test::read_file(folder_ / "a.cap");
  const std::string log = navcal::test::read_file(folder_ / "a.mcap");
  const std::string words = "this file is both input and output";
  expect_refused("log export --cap a.mcap a.mcap", 2, words);
  expect_refused("log export --cap ./a.cap a.cap", 2, words);
  expect_refused("log export --mat a.mcap a.mcap", 2, words);
  expect_refused("log export --cap link.cap a.cap", 2, words);
  expect_refused("log export --cap part.cap a.cap", 2, words);
  expect_refused("log import -o a.cap a.cap", 2, words);
  expect_refused("calibrate --report a.cap a.cap", 2, words);
  expect_refused("gap --json a.cap a.cap", 2, words);
  expect_refused("gap --report h.cap --holdout h.cap a.cap", 2, words);
  EXPECT_EQ(navcal::test::read_file(folder_ / "a.cap"), capture);
  EXPECT_EQ(navcal::test::read_file(folder_ / "a.mcap"), log);
}

TEST_F(WrongUsage, NoOutputIsWrittenOverAnother) {
  expect_refused("simulate --mission survey --seconds 5 -o y.cap --truth y.cap", 2, "two outputs have this name");
  expect_refused("simulate --mission survey --seconds 5 -o y.cap --truth y.cap.part", 2,
                 "two outputs have this name");
  expect_refused("gap --json a.html --report a.html a.cap", 2, "two outputs have this name");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "y.cap"));
}

TEST_F(WrongUsage, ANameThatPromisesAnotherKindOfFileIsRefused) {
  expect_refused("simulate --mission survey --seconds 5 -o a.mcap", 2, "navcal log import");
  ASSERT_EQ(run("simulate --mission survey --seconds 5 -o a.cap").status, 0);
  expect_refused("log export --cap b.mcap a.cap", 2, "navcal log import");
  expect_refused("log import -o b.cap a.cap", 2, "navcal log export --cap");
}

TEST_F(WrongUsage, AMisspeltNameGetsTheNearest) {
  expect_refused("clibrate a.cap", 2, "there is no command clibrate; did you mean calibrate?");
  expect_refused("log exprot a.mcap", 2, "navcal log: there is no command exprot; did you mean export?");
  expect_refused("simulate --mision survey -o a.cap", 2,
                 "navcal simulate: there is no option --mision; did you mean --mission?");
  expect_refused("xyzzyxyzzy", 2, "there is no command xyzzyxyzzy (navcal --help)");
}

TEST_F(WrongUsage, WatchWantsAPortAndAConnection) {
  expect_refused("watch --port abc", 2, "--port");
  expect_refused("watch --port 22222222", 2, "--port");
  expect_refused("watch --port 0", 2, "--port");
  // Port 1 is privileged and unused: nobody answers there.
  expect_refused("watch --port 1 --seconds 0.3 --json", 1,
                 "no connection to 127.0.0.1 port 1: Connection refused");
}

TEST_F(WrongUsage, AnEmptyFileIsToldAsOne) {
  std::ofstream(folder_ / "empty.cap");
  for (const char* const command :
       {"calibrate empty.cap", "replay empty.cap", "gap empty.cap", "log info empty.cap", "log finish empty.cap",
        "log import -o a.mcap empty.cap", "log export --cap a.cap empty.cap"}) {
    expect_refused(command, 3, "empty.cap: the file is empty");
  }
  std::ofstream(folder_ / "empty.toml");
  for (const char* const command : {"simulate --mission survey --vehicle empty.toml --seconds 1 -o a.cap",
                                    "simulate --mission ./empty.toml -o a.cap",
                                    "simulate --mission survey --seconds 1 --effects empty.toml -o a.cap"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.errors.find("Success"), std::string::npos) << command << '\n' << outcome.errors;
  }
}

}  // namespace
}  // namespace navcal::cli
