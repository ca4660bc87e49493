// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::cli::test {

/// Runs navcal in a fresh folder, with the command line as people type it in a shell. What it writes is in the
/// files `out` and `err` there.
class ProgramInFolder : public testing::Test {
 protected:
  /// Its exit status; -1 when a signal ended it.
  int run_navcal(const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.path().string() + "' && '" NAVCAL_PROGRAM "' " + arguments + " > out 2> err < /dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string said(const std::string& file) const { return navcal::test::read_file(folder_ / file); }
  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_ / file) << text; }

  navcal::test::TemporaryFolder folder_;
};

}  // namespace navcal::cli::test
