// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "analysis/import/log_readers.h"
#include "record/recording.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"

namespace navcal::analysis {
namespace {

using testing::expect_vector;
using testing::RecordingSink;

ImportFindings read(const std::string& csv, const std::string& toml, RecordingSink& sink) {
  return read_csv(csv, config::parse_csv_map(toml, "map.toml"), sink);
}

constexpr const char* kMap = R"map(
[time]
column = "t"
format = "unix_s"
[column.gx]
meaning = "rate_x"
unit = "deg/s"
[column.gy]
meaning = "rate_y"
unit = "deg/s"
[column.gz]
meaning = "rate_z"
unit = "deg/s"
[column.depth]
meaning = "depth"
unit = "cm"
offset = -20
[column."O2 (umol/l)"]
meaning = "sensor"
quantity = "oxygen"
unit = "umol/l"
)map";

TEST(Csv, ColumnsBecomeSamplesByTheMap) {
  RecordingSink sink;
  const auto findings = read(
      "t,gx,gy,gz,depth,\"O2 (umol/l)\",unused\n"
      "1700000000.000000001,180,0,-90,520,250.5,x\n"
      "1700000000.5,180,,-90,,,\r\n",
      kMap, sink);
  EXPECT_TRUE(findings.times_are_utc);
  EXPECT_FALSE(findings.cut_at);
  ASSERT_EQ(sink.samples.size(), 3U);
  EXPECT_EQ(sink.samples[0].port, "imu");
  EXPECT_EQ(sink.samples[0].time_ns, 1'700'000'000'000'000'001) << "no digit of a time is lost";
  expect_vector(sink.samples[0].line["rate_rad_s"], 3.14159265358979, 0, -1.5707963267949);
  EXPECT_NEAR(sink.of_port("depth").at(0).line["depth_m"].get<double>(), 5, 1e-12);
  const auto sensor = sink.of_port("sensors").at(0);
  EXPECT_EQ(sensor.line["quantity"], "oxygen");
  EXPECT_EQ(sensor.line["unit"], "umol/l");
  EXPECT_EQ(sensor.line["value"], 250.5);
}

TEST(Csv, SemicolonsDecimalCommasCommentsAndDatesOfTwoColumns) {
  RecordingSink sink;
  const auto findings = read(
      "# written by a logger\n"
      "Datum;Zeit;Tiefe;Kurs\n"
      "24.11.2026;13:00:00,25;3,5;-90\n",
      R"(
delimiter = ";"
decimal = ","
comment = "#"
header = 2
[time]
column = ["Datum", "Zeit"]
format = "%d.%m.%Y %H:%M:%S"
[column.Tiefe]
meaning = "depth"
[column.Kurs]
meaning = "heading"
unit = "deg"
)",
      sink);
  EXPECT_TRUE(findings.times_are_utc);
  ASSERT_EQ(sink.samples.size(), 2U);
  EXPECT_EQ(sink.samples[0].time_ns, 1'795'525'200'250'000'000);
  EXPECT_NEAR(sink.of_port("compass").at(0).line["heading_rad"].get<double>(), 3 * 3.14159265358979 / 2, 1e-12);
  EXPECT_EQ(sink.of_port("depth").at(0).line["depth_m"], 3.5);
}

TEST(Csv, TimesSinceAMomentHaveUtcOnlyWhereTheMapStatesIt) {
  const std::string columns = "[column.2]\nmeaning = \"pressure\"\nunit = \"hPa\"\n";
  const std::string head = "header = 0\ndelimiter = \"tab\"\n[time]\ncolumn = \"1\"\nformat = \"ms\"\n";
  RecordingSink sink;
  EXPECT_FALSE(read("1500.25\t1013.25\n", head + columns, sink).times_are_utc);
  EXPECT_EQ(sink.samples.at(0).time_ns, 1'500'250'000);
  EXPECT_NEAR(sink.samples.at(0).line["pressure_Pa"].get<double>(), 101'325, 1e-9);
  RecordingSink started;
  EXPECT_TRUE(read("1500.25\t1013.25\n", head + "start = \"2024-05-01T12:00:00+02:00\"\n" + columns, started)
                  .times_are_utc);
  EXPECT_EQ(started.samples.at(0).time_ns, 1'714'557'601'500'250'000);
}

TEST(Csv, WhatCannotBeReadIsCounted) {
  RecordingSink sink;
  const auto findings = read(
      "t,gx,gy,gz,depth,O2 (umol/l)\n"
      "never,1,2,3,4,5\n"
      "1700000000,1,2\n"
      "1700000001,1,2,high,4,5\n"
      "1700000002,1,2,3",
      kMap, sink);
  EXPECT_EQ(sink.left_counts["row (no time)"], 1);
  EXPECT_EQ(sink.left_counts["row (fewer cells than columns)"], 1);
  EXPECT_EQ(sink.left_counts["gz (no number)"], 1);
  EXPECT_EQ(sink.samples.size(), 2U) << "depth and oxygen of the one good row";
  EXPECT_TRUE(findings.cut_at) << "the last row has no end";
}

TEST(Csv, EverySampleIsInTheLogOrCountedAsLeft) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "map.toml") << kMap;
  const auto written =
      testing::expect_counts_agree("csv",
                                   "t,gx,gy,gz,depth,\"O2 (umol/l)\"\n1700000000,180,0,-90,520,250\n"
                                   "1700000001,180,0,-90,99999999,\n",
                                   (folder / "map.toml").string());
  EXPECT_EQ(written, (testing::PortCounts{{"depth", 1}, {"imu", 2}, {"sensors", 1}}));
}

TEST(Csv, AColumnThatIsMissingIsNamed) {
  RecordingSink sink;
  try {
    (void)read("t,gx,gy,gz,depth\n", kMap, sink);
    FAIL() << "it was read";
  } catch (const record::BadRecording& error) {
    EXPECT_NE(std::string(error.what()).find("no column \"O2 (umol/l)\"; there are t, gx, gy, gz, depth"),
              std::string::npos)
        << error.what();
  }
}

TEST(Csv, NoCutAndNoDamageBringsItDown) {
  const std::string rows =
      "1700000000.1,180,0,-90,520,250.5\n1700000000.2,\"180\",0,-90,520,250.5\n1700000000.3,1,2,3,4,5\n";
  const auto map =
      config::parse_csv_map("header = 0\n[time]\ncolumn = \"1\"\n[column.5]\nmeaning = \"depth\"\n", "map");
  testing::expect_robust(rows,
                         [&](const std::string& file, ImportSink& sink) { return read_csv(file, map, sink); });
}

TEST(Csv, MotorColumnsAreThoseOfAMotorCardAndOneFinCounts) {
  RecordingSink sink;
  const auto findings = read("0,1900,1500,2.5,0.5,0.25\n0.1,2000,,,,\n", R"(
header = 0
[time]
column = "1"
format = "s"
[column.2]
meaning = "rpm_commanded"
from = [1100, 1900]
to = [-20, 20]
unit = "rps"
[column.3]
meaning = "fin_2"
from = [1000, 2000]
to = [-25, 25]
unit = "deg"
[column.4]
meaning = "motor_current"
[column.5]
meaning = "imu_depth"
[column.6]
meaning = "rate_yaw_b"
unit = "deg/s"
)",
                             sink);
  const auto motor = sink.of_port("motor");
  ASSERT_EQ(motor.size(), 2U);
  EXPECT_EQ(motor[0].line["rpm_commanded"], 1200);
  EXPECT_EQ(motor[0].line["fins_rad"].dump(), "[null,0,null]");
  EXPECT_EQ(motor[0].line["current_A"], 2.5);
  EXPECT_FALSE(motor[1].line.contains("fins_rad"));
  EXPECT_EQ(sink.of_port("imu").at(0).line["depth_m"], 0.5);
  EXPECT_NEAR(sink.of_port("imu").at(0).line["yaw_rate_b_rad_s"].get<double>(), 0.25 * 3.14159265358979 / 180,
              1e-12);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_EQ(findings.remarks[0], "2: 1 values lie beyond 1100 to 1900, and count as its ends");
}

}  // namespace
}  // namespace navcal::analysis
