// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
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
  expect_refused("gap trial --cases 1 --layout a.cap --json a.cap", 2, words);
  expect_refused("log import -o a.mcap a.cap", 1, "a.mcap: the file exists and is not overwritten");
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

TEST_F(WrongUsage, AWindowWithoutAReadingIsNoEmptyAnswer) {
  ASSERT_EQ(run("simulate --mission survey --seconds 20 -o a.cap").status, 0);
  std::filesystem::copy(NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml", folder_ / "v.toml");
  for (const char* command : {"calibrate", "audit", "gap", "identify --vehicle v.toml -o w.toml", "noise"}) {
    const auto with = [&](const char* window) { return std::string(command) + " a.cap " + window; };
    const std::string nothing = "--from and --to leave nothing of the recording, which is ";
    expect_refused(with("--from 9 --to 3"), 2,
                   command == std::string("noise") ? nothing : "--from 9 is not before --to 3");
    expect_refused(with("--from 3000"), 2, nothing);
    expect_refused(with("--to 0"), 2, nothing);
  }
  expect_refused("calibrate a.cap --from 2026-01-01T00:00:09Z --to 2026-01-01T00:00:09Z", 2, "is not before");
  expect_refused("calibrate a.cap --from 5 --to 2025-01-01T00:00:00Z", 2, "leave nothing of the recording");
  EXPECT_EQ(run("calibrate a.cap --from 2026-01-01T00:00:05Z").status, 0);
  // A log that is imported for the audit keeps its name in messages.
  std::filesystem::copy(NAVCAL_SOURCE_DIR "/share/samples/three-faults.BIN", folder_ / "dive.BIN");
  const auto outside = run("audit dive.BIN --from 9000");
  EXPECT_EQ(outside.status, 2);
  EXPECT_EQ(outside.errors.substr(0, 40), "navcal: dive.BIN: --from and --to leave ") << outside.errors;
  // The first file of a series may lie before the window.
  ASSERT_EQ(run("simulate --mission survey --seconds 20 --date 2026-01-02 -o b.cap").status, 0);
  EXPECT_EQ(run("calibrate a.cap b.cap --from 2026-01-01T12:00:00Z").status, 0);
}

TEST_F(WrongUsage, AFileThatCannotBeReadIsBadInputAndNamedOnce) {
  ASSERT_EQ(run("simulate --mission survey --seconds 5 -o a.cap").status, 0);
  for (const char* command : {"replay no.cap",
                              "calibrate no.cap",
                              "audit no.cap",
                              "noise no.cap",
                              "gap no.cap",
                              "view no.cap",
                              "log info no.cap",
                              "log finish no.mcap",
                              "log export --csv d no.mcap",
                              "log export --cap d.cap no.cap",
                              "log import -o n.mcap no.bin",
                              "log import --driver nmea -o n.mcap no.nmea",
                              "log surfacings no.cap",
                              "gap --from no.json --export sitl",
                              "simulate --path no.csv -o n.cap",
                              "decode --protocol nmea no.bin",
                              "validate-runs --nominal no --runs no --json -",
                              "ports send-calibration no --parameters no.param",
                              "remote tcp:localhost:1 --key-file no.key",
                              "gap a.cap --holdout no.cap",
                              "gap trial --cases 1 --layout no.toml"}) {
    expect_refused(command, 3, ": No such file or directory");
    const std::string said = run(command).errors;
    EXPECT_EQ(said.find(" no"), said.rfind(" no")) << said;
    EXPECT_EQ(said.find("error"), std::string::npos) << said;
  }
  // A file that cannot be written is no bad input.
  for (const char* command : {"emulate --dir /proc/no", "play a.cap --dir /proc/no", "fleet plan -o /proc/no ."})
    expect_refused(command, 1, "navcal: /proc/no: No such file or directory");
  expect_refused("log import -o /proc/no.mcap a.cap", 1, "navcal: /proc/no.mcap: No such file or directory");
}

TEST_F(WrongUsage, ARemarkNamesItsFileOnce) {
  ASSERT_EQ(run("simulate --mission survey --seconds 20 -o a.cap").status, 0);
  std::filesystem::resize_file(folder_ / "a.cap", std::filesystem::file_size(folder_ / "a.cap") - 3);
  for (const char* command : {"replay", "calibrate", "audit", "noise", "log info", "log surfacings"}) {
    const std::string said = run(std::string(command) + " a.cap").errors;
    EXPECT_NE(said.find("a.cap:"), std::string::npos) << command;
    EXPECT_EQ(said.find("a.cap:"), said.rfind("a.cap:")) << said;
  }
}

TEST_F(WrongUsage, ARecordingIsNoCheckOfItself) {
  ASSERT_EQ(run("simulate --mission survey --seconds 20 -o a.cap").status, 0);
  std::filesystem::copy_file(folder_ / "a.cap", folder_ / "b.cap");
  expect_refused("gap a.cap --holdout b.cap", 2, " s of it are in a.cap as well. An answer can only be checked");
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

TEST_F(WrongUsage, WithoutACommandTheGroupsAreShown) {
  expect_refused("", 2, "\nDiagnose:\n");
  expect_refused("log", 2, "surfacings");
  expect_refused("research", 2, "gap-trial");
}

TEST_F(WrongUsage, TheLinesToStartWithoutAVehicleWorkAsTyped) {
  ASSERT_EQ(run("--help").status, 0);
  std::istringstream help(navcal::test::read_file(folder_ / "out"));
  std::string line;
  while (std::getline(help, line) && !line.starts_with("Start without")) {
  }
  int lines = 0;
  while (std::getline(help, line) && line.starts_with("  navcal ")) {
    ++lines;
    // The recording is shown until Ctrl-C.
    const std::string arguments = line.substr(9);
    if (!arguments.starts_with("view ")) {
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.status, 0) << line << '\n' << outcome.errors;
      continue;
    }
    const std::string command = "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' " + arguments +
                                " > view & pid=$!; until grep -q http:// '" + (folder_ / "view").string() +
                                "' || ! kill -0 $pid; do sleep 0.1; done; kill -INT $pid; wait $pid";
    EXPECT_EQ(std::system(command.c_str()), 0) << line;
  }
  EXPECT_EQ(lines, 3);
}

TEST_F(WrongUsage, SaysWhatToGive) {
  const Outcome typical = run("simulate --mission survey --seconds 1 --effect hard_iron -o a.cap");
  EXPECT_EQ(typical.status, 0);
  EXPECT_NE(typical.errors.find("strength 1, the typical one"), std::string::npos) << typical.errors;
  ASSERT_EQ(run("simulate --mission survey --seconds 1 --effect hard_iron=1 -o b.cap").status, 0);
  EXPECT_EQ(navcal::test::read_file(folder_ / "a.cap"), navcal::test::read_file(folder_ / "b.cap"));
  expect_refused("emulate --dir ports --seconds 0.1 --effect hard_iron", 0, "--effect hard_iron=0.5");

  std::ofstream(folder_ / "x.csv") << "t,z\n1700000000,1.5\n";
  expect_refused("log import -o x.mcap x.csv", 3, "x.csv: a CSV file needs a map of its columns: --map FILE.toml");
  // The map that the message shows is one.
  std::istringstream said(run("log import -o x.mcap x.csv").errors);
  std::ofstream map(folder_ / "map.toml");
  for (std::string line; std::getline(said, line);) {
    if (line.starts_with("  ")) map << line << '\n';
  }
  map.close();
  EXPECT_EQ(run("log import --map map.toml -o x.mcap x.csv").status, 0);

  ASSERT_EQ(run("gap watch --help").status, 0);
  EXPECT_NE(navcal::test::read_file(folder_ / "out").find("navcal gap watch --recording a.cap"),
            std::string::npos);
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
