// SPDX-License-Identifier: Apache-2.0
// A recording that is given twice, by the program.
#include <filesystem>

#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

using RepeatedRecording = test::ProgramInFolder;

TEST_F(RepeatedRecording, CountsOnceAndIsTold) {
  ASSERT_EQ(run_navcal("simulate --mission survey --seconds 60 -o a.cap"), 0) << said("err");
  std::filesystem::copy_file(folder_ / "a.cap", folder_ / "b.cap");
  for (const std::string command : {"calibrate --json", "log surfacings --json"}) {
    ASSERT_EQ(run_navcal(command + " a.cap"), 0) << said("err");
    const std::string once = said("out");
    ASSERT_EQ(run_navcal(command + " a.cap b.cap"), 0) << said("err");
    EXPECT_EQ(said("out"), once) << command;
    EXPECT_NE(said("err").find("s of it are in a.cap as well, so it is left out: a recording counts once"),
              std::string::npos)
        << said("err");
  }
  ASSERT_EQ(run_navcal("gap a.cap b.cap --bank 10 --cache bank --json -"), 0) << said("err");
  EXPECT_NE(said("out").find("s of it are in a.cap as well, so it is left out"), std::string::npos) << said("out");
}

}  // namespace
}  // namespace navcal::cli
