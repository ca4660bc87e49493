#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli::test {

/// `navcal calibrate` in a folder of its own.
class CalibrateCommand : public ::testing::Test {
 protected:
  struct Outcome {
    int status = 0;
    std::string message, output;
  };
  Outcome run(std::vector<std::string> arguments) {
    CLI::App app;
    add_calibrate(app);
    arguments.insert(arguments.begin(), "calibrate");
    std::reverse(arguments.begin(), arguments.end());
    Outcome outcome;
    ::testing::internal::CaptureStdout();
    try {
      app.parse(std::move(arguments));
    } catch (const CLI::ParseError& error) {
      outcome = {static_cast<int>(Exit::usage), error.what(), ""};
    } catch (const Failure& failure) {
      outcome = {static_cast<int>(failure.status()), failure.what(), ""};
    }
    outcome.output = ::testing::internal::GetCapturedStdout();
    return outcome;
  }
  /// The file's path.
  std::string write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }

  navcal::test::TemporaryFolder folder_;
};

}  // namespace navcal::cli::test
