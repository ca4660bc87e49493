// SPDX-License-Identifier: Apache-2.0
#include "config/csv_map.h"

#include <gtest/gtest.h>

#include "config/error.h"

namespace navcal::config {
namespace {

std::string map_problems(const std::string& toml) {
  try {
    (void)parse_csv_map(toml, "map.toml");
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(CsvMap, ReadsColumnsWithTheirUnits) {
  const CsvMap map = parse_csv_map(
      "delimiter = \";\"\n[time]\ncolumn = \"t\"\nformat = \"unix_ms\"\n"
      "[column.mx]\nmeaning = \"field_x\"\nunit = \"nT\"\ninstance = 2\nscale = 2\noffset = 5\n",
      "map.toml");
  EXPECT_EQ(map.delimiter, ';');
  EXPECT_EQ(map.time, CsvTime::unix_ms);
  ASSERT_EQ(map.columns.size(), 1U);
  EXPECT_EQ(map.columns[0].meaning, CsvMeaning::field_x);
  EXPECT_DOUBLE_EQ(map.columns[0].factor, 2e-3);
  EXPECT_DOUBLE_EQ(map.columns[0].offset, 5e-3);
  EXPECT_EQ(map.columns[0].instance, 1);
}

TEST(CsvMap, ProblemsNameLineAndKey) {
  const std::string problems = map_problems(
      "delimitter = \",\"\n[time]\ncolumn = \"t\"\nformat = \"unixs\"\n[column.a]\nmeaning = \"heading\"\nunit = "
      "\"nT\"\n"
      "[column.b]\nunit = \"m\"\n[column.c]\nmeaning = \"speeed\"\n");
  EXPECT_NE(problems.find("map.toml:1: delimitter: unknown key; did you mean delimiter?"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("map.toml:4: time.format: one of unix_s"), std::string::npos) << problems;
  EXPECT_NE(problems.find("map.toml:7: column.a.unit: one of rad, deg is expected"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("column.b: meaning is missing"), std::string::npos) << problems;
  EXPECT_NE(problems.find("map.toml:11: column.c.meaning: one of heading, pitch"), std::string::npos) << problems;
  EXPECT_NE(map_problems("[time]\ncolumn = \"t\"\n").find("a map has a [column.NAME] or more"), std::string::npos);
}

TEST(CsvMap, TimesOfIso8601) {
  EXPECT_EQ(parse_iso_time("2024-05-01T12:00:00.25Z"), 1'714'564'800'250'000'000);
  EXPECT_EQ(parse_iso_time("2024-05-01 12:00:00"), 1'714'564'800'000'000'000);
  EXPECT_EQ(parse_iso_time("2024-05-01T14:00:00+02:00"), 1'714'564'800'000'000'000);
  EXPECT_EQ(parse_iso_time("2024-05-01T14:00:00.000000001-0130"), 1'714'577'400'000'000'001);
  for (const char* const text : {"", "2024-05-01", "2024-13-01T12:00:00Z", "2024-05-01T25:00:00Z",
                                 "2024-05-01T12:00:00X", "2024-05-01T12:00:00+2", "2024-05-01T12-00-00Z"}) {
    EXPECT_EQ(parse_iso_time(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace navcal::config
