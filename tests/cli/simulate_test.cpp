// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/report/markup.h"
#include "tests/support/temporary_folder.h"

// The program itself, run by a shell as people run it.
namespace navcal::cli {
namespace {

const std::string kPort = "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/ttyS0\"\nbaud = 38400\n";
const std::string kPath = NAVCAL_SOURCE_DIR "/fixtures/paths/path3.csv";

class Simulate : public testing::Test {
 protected:
  struct Outcome {
    int status = 0;
    std::string output, errors;
  };
  [[nodiscard]] Outcome run(const std::string& shell) const {
    const auto script = folder_ / "script";
    std::ofstream(script) << "cd '" << folder_.path().string() << "'\nset -o pipefail\nnavcal() { '"
                          << NAVCAL_PROGRAM << "' \"$@\"; }\n"
                          << shell << '\n';
    const std::string command = "bash " + script.string() + " > " + (folder_ / "out").string() + " 2> " +
                                (folder_ / "err").string() + " < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, navcal::test::read_file(folder_ / "out"),
            navcal::test::read_file(folder_ / "err")};
  }
  void expect_files(const std::vector<std::string>& wanted) const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      if (name != "script" && name != "out" && name != "err") found.push_back(name);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, wanted);
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(Simulate, DecodeFindsNoBadFrameInWhatItWrites) {
  ASSERT_EQ(run("navcal simulate --path " + kPath + " -o a.cap").status, 0);
  for (const auto& [port, protocol] :
       {std::pair{"compass", "tcm2"}, {"imu", "imu-card"}, {"gps", "oncore"}, {"motor", "motor-card"}}) {
    const auto decoded = run("awk '$2 == \"" + std::string(port) + "\" && $3 == \"<\" {print $4}' a.cap | " +
                             "sed 's/../\\\\x&/g' | tr -d '\\n' | xargs -0 printf '%b' > raw; " +
                             "navcal decode --json --protocol " + protocol + " raw | tail -n 1");
    const auto summary = nlohmann::json::parse(decoded.output);
    EXPECT_EQ(summary["bad_checksum"], 0) << port;
    EXPECT_EQ(summary["skipped_bytes"], 0) << port;
    EXPECT_GT(summary["framed_bytes"], 1000) << port;
  }
}

TEST_F(Simulate, TheSameSeedGivesTheSameBytesAndAnotherOthers) {
  const std::string simulate = "navcal simulate --drive " + kPath + " --effect motor_field=1 --effect stalls=1 ";
  const auto outcome =
      run(simulate + "--seed 4 -o a.cap --truth a.csv && " + simulate + "--seed 4 -o b.cap --truth b.csv && " +
          simulate + "--seed 5 -o c.cap && " + "cmp a.cap b.cap && cmp a.csv b.csv && ! cmp -s a.cap c.cap");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

TEST_F(Simulate, TheTruthDrivesTheVehicleToTheSamePlaceAgain) {
  const auto outcome =
      run("navcal simulate --mission survey --seconds 60 -o a.cap --truth a.csv && "
          "navcal simulate --drive a.csv -o b.cap --truth b.csv && tail -qn 1 a.csv b.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::istringstream rows(outcome.output);
  std::string a, b;
  std::getline(rows, a);
  std::getline(rows, b);
  for (std::istringstream one(a), two(b); one.good();) {
    std::string x, y;
    std::getline(one, x, ',');
    std::getline(two, y, ',');
    // A drive holds the fins over a step, as the reference paths were made; a mission lets them move.
    EXPECT_NEAR(std::stod(x), std::stod(y), 5e-4) << a << '\n' << b;
  }
}

TEST_F(Simulate, ThePageIsWholeAndShowsMotionInstrumentsAndEffects) {
  const auto outcome =
      run("navcal simulate --path " + kPath + " --effect motor_field=1 -o a.cap --report a.html && cat a.html");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(test::flaw_in(outcome.output), "");
  for (const char* title :
       {"Track", "Heading", "Depth", "Speed", "Fins", "Gyros", "Field", "Accelerometers", "x_uT_per_A"}) {
    EXPECT_NE(outcome.output.find(title), std::string::npos) << title;
  }
  expect_files({"a.cap", "a.html"});
}

TEST_F(Simulate, TheConfigurationSetsTheInstrumentsAndOtherwiseNothing) {
  const std::string simulate = "navcal simulate --path " + kPath + " --seconds 20 ";
  write("same.toml", kPort);
  write("noisy.toml", kPort + "[instruments]\ncompass_field_noise_uT = 5\n");
  ASSERT_EQ(run(simulate + "-o a.cap; " + simulate + "--config same.toml -o b.cap; cmp a.cap b.cap").status, 0);
  const auto differing = run(simulate + "--config noisy.toml -o c.cap; for port in compass imu gps motor; do " +
                             "cmp -s <(grep \" $port <\" a.cap) <(grep \" $port <\" c.cap) || echo $port; done");
  EXPECT_EQ(differing.output, "compass\n") << differing.errors;
}

TEST_F(Simulate, APictureWithoutReadingsIsLeftOutWithAWord) {
  const auto outcome =
      run("navcal simulate --path " + kPath + " --seconds 0.01 -o a.cap --report a.html && cat a.html");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_EQ(test::flaw_in(outcome.output), "");
  EXPECT_NE(outcome.output.find("No readings in the recording: "), std::string::npos);
  EXPECT_EQ(outcome.output.find("<h3>Shaft</h3>"), std::string::npos);
}

struct Refusal {
  const char* what;
  const char* command;
  int status;
  const char* said;
};

TEST_F(Simulate, RefusesWithTheReasonAndLeavesNothingBehind) {
  write("bad.csv", "t,x\n");
  write("effects.toml", "\n[motor_fields]\nx_uT_per_A = 1\n");
  write("range.toml", "[fin_lag]\ntau_s = -1\n");
  write("bad.toml", kPort + "[instruments]\ncompass_tilt_lag_s = -1\n");
  for (const auto& [what, command, status, said] : std::vector<Refusal>{
           {"no motion", "-o a.cap", 2, "one of --path, --drive and --mission"},
           {"two motions", "--mission survey --drive x.csv -o a.cap", 2, "one of --path, --drive and --mission"},
           {"no output", "--mission survey", 2, "-o FILE.cap"},
           {"no such file", "--path none.csv -o a.cap", 3, "none.csv"},
           {"not a path", "--path bad.csv -o a.cap", 3, "bad.csv:1: "},
           {"no such mission", "--mission nowhere -o a.cap", 3, "nowhere"},
           {"unknown effect", "--mission survey --effect motor_fields=1 -o a.cap", 2, "did you mean motor_field?"},
           {"no strength", "--mission survey --effect motor_field=x -o a.cap", 2, "NAME=STRENGTH is expected"},
           {"beyond its range", "--mission survey --effect fin_lag=1000 -o a.cap", 2,
            "tau_s lies between 0 and 5"},
           {"unknown in a file", "--mission survey --effects effects.toml -o a.cap", 3,
            "effects.toml:2: motor_fields"},
           {"range in a file", "--mission survey --effects range.toml -o a.cap", 3, "range.toml:2: fin_lag.tau_s"},
           {"no such effects", "--mission survey --effects none.toml -o a.cap", 3, "none.toml"},
           {"a path that is driven off",
            "--path " NAVCAL_SOURCE_DIR "/fixtures/paths/path3.csv --effect buoyancy=1 -o a.cap", 2,
            "buoyancy changes the vehicle's motion"},
           {"an instrument beyond its range", "--mission survey --config bad.toml -o a.cap", 3,
            "bad.toml:6: instruments.compass_tilt_lag_s: -1 is out of range"},
           {"no such configuration", "--mission survey --config none.toml -o a.cap", 3, "none.toml"},
           {"nowhere to write", "--mission survey --seconds 1 -o none/a.cap", 1, "none/a.cap"}}) {
    const auto outcome = run(std::string("navcal simulate ") + command);
    EXPECT_EQ(outcome.status, status) << what << ": " << outcome.errors;
    EXPECT_NE(outcome.errors.find(said), std::string::npos) << what << ": " << outcome.errors;
  }
  expect_files({"bad.csv", "bad.toml", "effects.toml", "range.toml"});
}

// A file in the place of a device or pipe would be the end of it for every other program.
TEST_F(Simulate, APipeIsWrittenToAndStaysAPipe) {
  const auto outcome =
      run("mkfifo pipe && { wc -c < pipe > counted & } && '" NAVCAL_PROGRAM
          "' simulate --mission survey --seconds 2 -o a.cap --truth pipe && wait && test -p pipe && "
          "test $(cat counted) -gt 100 && '" NAVCAL_PROGRAM
          "' simulate --mission survey --seconds 2 -o /dev/stdout --truth /dev/null | cmp - a.cap && "
          "test -c /dev/null");
  EXPECT_EQ(outcome.status, 0) << outcome.output << outcome.errors;
}

TEST_F(Simulate, InterruptedItLeavesNoHalfFile) {
  const auto outcome = run("'" NAVCAL_PROGRAM
                           "' simulate --mission survey --seconds 500000 -o a.cap --truth a.csv & "
                           "until [ -s a.cap.part ]; do sleep 0.01; done; kill -INT $!; wait $!");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  expect_files({});
}

}  // namespace
}  // namespace navcal::cli
