// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace navcal::record::testing {

/// A test with a folder of its own.
class TemporaryFolder : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  static std::string read(const std::filesystem::path& file) { return test::read_file(file); }

 private:
  test::TemporaryFolder folder_;

 protected:
  const std::filesystem::path path_ = folder_.path();
};

}  // namespace navcal::record::testing
