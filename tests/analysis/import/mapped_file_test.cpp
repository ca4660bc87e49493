// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/mapped_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "analysis/import/import_log.h"
#include "record/recording.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

TEST(MappedFile, WhatIsCutWhileItIsReadIsZeroAndTold) {
  const test::TemporaryFolder folder;
  const auto path = folder / "a";
  std::ofstream(path) << std::string(1 << 20, 'x');
  {
    const MappedFile file(path);
    EXPECT_EQ(std::count(file.bytes().begin(), file.bytes().end(), 'x'), 1 << 20);
    EXPECT_TRUE(file.is_whole());
  }
  const MappedFile file(path);
  std::filesystem::resize_file(path, 1 << 16);
  EXPECT_EQ(std::count(file.bytes().begin(), file.bytes().end(), 'x'), 1 << 16);
  EXPECT_EQ(file.bytes().back(), '\0');
  EXPECT_FALSE(file.is_whole());
}

TEST(MappedFile, ADeviceIsRefusedByName) {
  try {
    const MappedFile file("/dev/null");
    FAIL() << "it was read";
  } catch (const record::BadRecording& error) {
    EXPECT_STREQ(error.what(), "/dev/null: a pipe or a device; logs are read from files");
  }
}

TEST(MappedFile, AnImportOfAFileThatIsCutMeanwhileIsAnErrorAndLeavesNothing) {
  const test::TemporaryFolder folder;
  const auto map = folder / "map.toml", csv = folder / "dive.csv", log = folder / "dive.mcap";
  std::ofstream(map)
      << "[time]\ncolumn = \"t\"\nformat = \"unix_s\"\n[column.a]\nmeaning = \"sensor\"\nunit = \"n\"\n";
  std::ofstream table(csv);
  table << "t,a\n";
  for (int i = 0; i < 200'000; ++i) table << 1'700'000'000 + i << ",1\n";
  table.close();
  bool is_cut = false;
  const auto cut = [&](double) {
    if (!std::exchange(is_cut, true)) std::filesystem::resize_file(csv, 1000);
  };
  try {
    (void)import_log(csv, log, {.format = "csv", .map = map}, cut);
    ADD_FAILURE() << "it was cut";
  } catch (const record::BadRecording& error) {
    EXPECT_NE(std::string(error.what()).find("cut"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(is_cut);
  EXPECT_FALSE(std::filesystem::exists(log));
}

}  // namespace
}  // namespace navcal::analysis
