// SPDX-License-Identifier: Apache-2.0
#include "config/csv_map.h"

#include <gtest/gtest.h>

#include <numbers>

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
  EXPECT_EQ(map.columns[0].meaning.name, "field_x");
  EXPECT_DOUBLE_EQ(map.columns[0].factor, 2e-3);
  EXPECT_DOUBLE_EQ(map.columns[0].offset, 5e-3);
  EXPECT_EQ(map.columns[0].instance, 1);
}

TEST(CsvMap, TakesTheNamesAndUnitsOfDescriptions) {
  const auto column = [](const std::string& keys) {
    return parse_csv_map("[time]\ncolumn = \"t\"\n[column.c]\n" + keys, "map.toml").columns.at(0);
  };
  const CsvColumn rate = column("meaning = \"rate.x\"\nunit = \"deg/h\"\n");
  EXPECT_EQ(rate.meaning.name, "rate_x");
  EXPECT_DOUBLE_EQ(rate.factor, std::numbers::pi / 180 / 3600);
  EXPECT_DOUBLE_EQ(column("meaning = \"specific_force.z\"\nunit = \"g\"\n").factor, 9.80665);
  EXPECT_EQ(column("meaning = \"depth\"\n").meaning.sample, "DEPTH");
  EXPECT_EQ(column("meaning = \"imu_depth\"\n").meaning.sample, "IMU");
  EXPECT_NE(map_problems("[time]\ncolumn = \"t\"\n[column.c]\nmeaning = \"temperature\"\n").find("one of heading"),
            std::string::npos)
      << "it may be of any instrument";
}

TEST(CsvMap, ProblemsNameLineAndKey) {
  const std::string problems = map_problems(
      "delimitter = \",\"\n[time]\ncolumn = \"t\"\nformat = \"unixs\"\n[column.a]\nmeaning = \"heading\"\nunit = "
      "\"nT\"\n"
      "[column.b]\nunit = \"m\"\n[column.c]\nmeaning = \"speeed\"\n");
  EXPECT_NE(problems.find("map.toml:1: delimitter: unknown key; did you mean delimiter?"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("map.toml:4: time.format: one of unix_s"), std::string::npos) << problems;
  EXPECT_NE(problems.find("map.toml:7: column.a.unit: one of rad, deg, arcmin, mils, counts16 is expected"),
            std::string::npos)
      << problems;
  EXPECT_NE(problems.find("column.b: meaning is missing"), std::string::npos) << problems;
  EXPECT_NE(problems.find("map.toml:11: column.c.meaning: one of heading, pitch"), std::string::npos) << problems;
  EXPECT_EQ(problems.find("column.c: meaning"), std::string::npos) << "a wrong one is not missing: " << problems;
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

TEST(CsvMap, ACurveIsStraightBetweenItsCornersAndEndsThere) {
  const CsvMap map = parse_csv_map(
      "[time]\ncolumn = \"t\"\n[column.c]\nmeaning = \"fin_1\"\nunit = \"deg\"\n"
      "from = [1100, 1475, 1525, 1900]\nto = [-20, 0, 0, 20]\n[column.d]\nmeaning = \"compass_temperature\"\n"
      "unit = \"K\"\n",
      "map.toml");
  constexpr double kDegree = 3.14159265358979 / 180;
  const CsvColumn& fin = map.columns.at(0);
  EXPECT_NEAR(fin.value(1100), -20 * kDegree, 1e-12);
  EXPECT_NEAR(fin.value(1287.5), -10 * kDegree, 1e-12);
  EXPECT_EQ(fin.value(1480), 0) << "a dead band";
  EXPECT_NEAR(fin.value(1712.5), 10 * kDegree, 1e-12);
  EXPECT_NEAR(fin.value(2100), 20 * kDegree, 1e-12);
  EXPECT_TRUE(fin.is_beyond(1099));
  EXPECT_FALSE(fin.is_beyond(1100));
  EXPECT_FALSE(fin.is_beyond(1900));
  EXPECT_NEAR(map.columns.at(1).value(300), 26.85, 1e-9);
  EXPECT_FALSE(map.columns.at(1).is_beyond(1e9)) << "it has no curve";
}

TEST(CsvMap, ACurveThatCannotBeDrawnIsNamedByLineAndKey) {
  const auto problem_of = [](const std::string& keys) {
    return map_problems("[time]\ncolumn = \"t\"\n[column.c]\nmeaning = \"rpm\"\n" + keys);
  };
  EXPECT_EQ(problem_of("from = [1, 1]\nto = [0, 5]\n"),
            "map.toml:5: column.c.from: two numbers or more are expected, each larger than the one before");
  EXPECT_EQ(problem_of("from = [1, 2, 3]\nto = [0, 5]\n"),
            "map.toml:6: column.c.to: as many numbers as \"from\" has are expected: 3");
  EXPECT_EQ(problem_of("from = [1, 2]\n"), "map.toml:3: column.c: \"from\" needs \"to\"");
  EXPECT_EQ(problem_of("scale = 2\nfrom = [1, 2]\nto = [0, 5]\n"),
            "map.toml:5: column.c.scale: \"from\" and \"to\" take the place of scale and offset");
  EXPECT_NE(problem_of("from = 5\nto = [0, 5]\n").find("map.toml:5: column.c.from: cannot be"), std::string::npos);
}

TEST(ChannelMap, HasShaftAndFinsOnly) {
  const ChannelMap map = parse_channel_map(
      "[column.\"RCOU.C1\"]\nmeaning = \"rpm_commanded\"\nfrom = [1100, 1900]\nto = [-20, 20]\nunit = \"rps\"\n",
      "map.toml");
  ASSERT_EQ(map.channels.size(), 1U);
  EXPECT_EQ(map.channels[0].name, "RCOU.C1");
  EXPECT_EQ(map.channels[0].line, 1U);
  EXPECT_DOUBLE_EQ(map.channels[0].value(1900), 1200) << "in rpm";
  try {
    (void)parse_channel_map("header = 1\n[time]\ncolumn = \"t\"\n[column.\"IMU.GyrX\"]\nmeaning = \"rate_x\"\n",
                            "map.toml");
    FAIL() << "it was read";
  } catch (const Error& error) {
    const std::string problems = error.what();
    EXPECT_NE(problems.find("map.toml:1: header: only tables [column.NAME] are known"), std::string::npos);
    EXPECT_NE(problems.find("map.toml:3: time.column: only tables"), std::string::npos) << problems;
    EXPECT_NE(problems.find("map.toml:4: column.IMU.GyrX.meaning: one of rpm, rpm_commanded, fin_1"),
              std::string::npos)
        << problems;
  }
}

}  // namespace
}  // namespace navcal::config
