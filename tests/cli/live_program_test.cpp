// SPDX-License-Identifier: Apache-2.0
// The program that tools/demo builds: the live subcommands, and what is said in place of the others.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

class LiveProgram : public testing::Test {
 protected:
  /// Exit status of `navcal ARGUMENTS`.
  [[nodiscard]] int run(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.path().string() +
                                "' && '" NAVCAL_BINARY_DIR "/cli/live/navcal' " + arguments +
                                " > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string text(const std::string& name) const { return navcal::test::read_file(folder_ / name); }

  navcal::test::TemporaryFolder folder_;
};

TEST_F(LiveProgram, RunsWhatIsLive) {
  for (const char* const arguments :
       {"--help", "emulate --help", "watch --help", "log info --help", "start --help"})
    EXPECT_EQ(run(arguments), 0) << arguments << '\n' << text("err");
  EXPECT_EQ(run("field --place 37.2,-80.4"), 0) << text("err");
  EXPECT_NE(text("out").find("field"), std::string::npos);
  EXPECT_EQ(run("emulat"), 2);
  EXPECT_NE(text("err").find("emulate"), std::string::npos) << text("err");
}

TEST_F(LiveProgram, SaysHowToGetTheOthers) {
  for (const char* const command :
       {"gap", "gap next a.cap", "audit dive.BIN --json", "simulate --help", "log import a.bin"}) {
    EXPECT_EQ(run(command), 1) << command;
    EXPECT_NE(text("err").find(" is not in this build"), std::string::npos) << command << '\n' << text("err");
    EXPECT_NE(text("err").find("--target navcal"), std::string::npos) << command << '\n' << text("err");
  }
  EXPECT_EQ(run("log import a.bin"), 1);
  EXPECT_NE(text("err").find("log import is not"), std::string::npos) << text("err");
}

}  // namespace
}  // namespace navcal::cli
