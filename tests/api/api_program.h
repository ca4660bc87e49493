// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <navcal/error.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "tests/cli/calibrate_program.h"

namespace navcal::api::test {

/// The library beside the program, in a folder of its own.
class ApiProgram : public cli::test::CalibrateProgram {
 protected:
  /// A simulated recording of that many seconds in which there is something to calibrate.
  std::filesystem::path swing(const std::string& name, int seconds, const std::string& options = {}) const {
    (void)output_of("simulate --mission calibration_swing --effect hard_iron=1 --seconds " +
                    std::to_string(seconds) + " -o " + name + " " + options);
    return folder_ / name;
  }
  /// A file of that content.
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    write(name, content);
    return folder_ / name;
  }
};

/// What the library threw, if it threw.
struct Thrown {
  ErrorKind kind = ErrorKind::failed;
  std::string message;

  [[nodiscard]] bool names(const std::string& words) const { return message.find(words) != std::string::npos; }
};

/// The Error that `job` throws; nullopt without one.
template <class Job>
std::optional<Thrown> error_of(Job&& job) {
  try {
    std::forward<Job>(job)();
  } catch (const Error& error) {
    return Thrown{error.kind(), error.what()};
  }
  return std::nullopt;
}

}  // namespace navcal::api::test
