// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/command_outcome.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli::test {

/// `navcal calibrate` in a folder of its own.
class CalibrateCommand : public ::testing::Test {
 protected:
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "calibrate");
    return run_command(add_calibrate, std::move(arguments));
  }
  /// The file's path.
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }

  navcal::test::TemporaryFolder folder_;
};

}  // namespace navcal::cli::test
