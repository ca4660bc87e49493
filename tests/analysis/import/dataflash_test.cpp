// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "analysis/import/gps_week.h"
#include "analysis/import/log_readers.h"
#include "instruments/autopilot_compass.h"
#include "tests/analysis/import/channel_map.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"
#include "tests/analysis/import/without_channels.h"
#include "tests/protocols/shared_capture.h"

namespace navcal::analysis {
namespace {

using testing::append_all;
using testing::append_number;
using testing::expect_vector;
using testing::RecordingSink;

/// Writes a DataFlash log as AP_Logger does, from its documentation.
class DataFlashWriter {
 public:
  DataFlashWriter() { format(128, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns"); }

  void format(std::uint8_t type, std::uint8_t length, const std::string& name, const std::string& formats,
              const std::string& columns) {
    head(128);
    out.push_back(static_cast<char>(type));
    out.push_back(static_cast<char>(length));
    text(name, 4);
    text(formats, 16);
    text(columns, 64);
  }
  void units_tables() {
    format(1, 3 + 8 + 1 + 64, "UNIT", "QbZ", "TimeUS,Id,Label");
    format(2, 3 + 8 + 1 + 8, "MULT", "Qbd", "TimeUS,Id,Mult");
    format(3, 3 + 8 + 1 + 32, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds");
  }
  void unit(char id, const std::string& label) {
    head(1);
    append_number(out, std::uint64_t{1});
    out.push_back(id);
    text(label, 64);
  }
  void multiplier(char id, double factor) {
    head(2);
    append_number(out, std::uint64_t{1});
    out.push_back(id);
    append_number(out, factor);
  }
  void units_of(std::uint8_t type, const std::string& units, const std::string& multipliers) {
    head(3);
    append_number(out, std::uint64_t{1});
    out.push_back(static_cast<char>(type));
    text(units, 16);
    text(multipliers, 16);
  }
  void head(std::uint8_t type) {
    out += "\xA3\x95";
    out.push_back(static_cast<char>(type));
  }
  void text(const std::string& what, std::size_t size) {
    out += what;
    out.append(size - what.size(), '\0');
  }

  std::string out;
};

void add_imu(DataFlashWriter& log, std::uint8_t type, std::uint64_t time_us, std::uint8_t instance) {
  log.head(type);
  append_number(log.out, time_us);
  append_number(log.out, instance);
  for (const float value : {0.5F, -0.25F, 0.125F, 0.5F, 1.0F, -9.75F}) append_number(log.out, value);
}

/// IMU, MAG, GPS, ATT, BAT, RCOU, BARO of one moment, with units.
std::string small_log() {
  DataFlashWriter log;
  log.units_tables();
  log.format(10, 3 + 8 + 1 + 24, "IMU", "QBffffff", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ");
  log.format(11, 3 + 8 + 1 + 6 + 1, "MAG", "QBhhhB", "TimeUS,I,MagX,MagY,MagZ,Health");
  log.format(12, 3 + 8 + 2 + 4 + 2 + 1 + 2 + 4 + 4 + 4 + 4 + 4 + 4, "GPS", "QBBIHBcLLefff",
             "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ");
  log.format(13, 3 + 8 + 6, "ATT", "Qccc", "TimeUS,Roll,Pitch,Yaw");
  log.format(14, 3 + 8 + 1 + 8, "BAT", "QBff", "TimeUS,Inst,Volt,Curr");
  log.format(15, 3 + 8 + 6, "RCOU", "QHHH", "TimeUS,C1,C2,C3");
  log.format(16, 3 + 8 + 1 + 8 + 2, "BARO", "QBffc", "TimeUS,I,Alt,Press,Temp");
  log.format(17, 3 + 8 + 64, "MSG", "QZ", "TimeUS,Message");
  log.format(18, 3 + 8 + 16 + 4, "PARM", "QNf", "TimeUS,Name,Value");
  log.unit('E', "rad/s");
  log.unit('G', "Gauss");
  log.unit('s', "s");
  log.multiplier('C', 1e-3);
  log.multiplier('F', 1e-6);
  log.multiplier('-', 0);
  log.units_of(11, "s#GGG-", "F-CCC-");
  log.head(18);
  append_number(log.out, std::uint64_t{1});
  log.text("BARO_PRIMARY", 16);
  append_number(log.out, 1.0F);
  log.head(17);
  append_number(log.out, std::uint64_t{1});
  log.text("ArduSub V4.1.0", 64);
  add_imu(log, 10, 1'000'000, 0);
  add_imu(log, 10, 1'000'000, 1);
  log.head(11);
  append_number(log.out, std::uint64_t{1'000'100});
  log.out.push_back('\0');
  append_all<std::int16_t>(log.out, {200, -50, 430});
  log.out.push_back('\1');
  log.head(12);
  append_number(log.out, std::uint64_t{1'250'000});
  log.out += std::string("\0\3", 2);
  append_number(log.out, std::uint32_t{302'400'250});
  append_number(log.out, std::uint16_t{2300});
  log.out.push_back('\x0B');
  append_number(log.out, std::int16_t{85});
  append_number(log.out, std::int32_t{475'000'001});
  append_number(log.out, std::int32_t{-1'225'000'000});
  append_number(log.out, std::int32_t{1234});
  for (const float value : {1.5F, 90.0F, -0.5F}) append_number(log.out, value);
  log.head(13);
  append_number(log.out, std::uint64_t{1'300'000});
  append_all<std::int16_t>(log.out, {-150, 300, 18000});
  log.head(14);
  append_number(log.out, std::uint64_t{1'400'000});
  log.out.push_back('\0');
  append_number(log.out, 15.5F);
  append_number(log.out, 2.25F);
  log.head(15);
  append_number(log.out, std::uint64_t{1'500'000});
  append_all<std::uint16_t>(log.out, {1500, 0, 1900});
  for (const char instance : {'\0', '\1'}) {
    log.head(16);
    append_number(log.out, std::uint64_t{1'600'000});
    log.out.push_back(instance);
    append_number(log.out, -3.5F);
    append_number(log.out, 135'000.0F);
    append_number(log.out, std::int16_t{1850});
  }
  return log.out;
}

TEST(DataFlash, TheErrorThatTheActiveEstimatorStatesOfItsHeadingGoesWithTheAttitude) {
  const auto stated = [](char active) {
    DataFlashWriter log;
    log.format(20, 3 + 8 + 1 + 16, "XKV1", "QBffff", "TimeUS,C,V00,V01,V02,V03");
    log.format(13, 3 + 8 + 6 + 1, "ATT", "QcccB", "TimeUS,Roll,Pitch,Yaw,AEKF");
    log.head(20);
    append_number(log.out, std::uint64_t{1'000'000});
    log.out.push_back('\0');
    for (const float variance : {0.0003F, 1.0F, 1.0F, 0.0001F}) append_number(log.out, variance);
    log.head(13);
    append_number(log.out, std::uint64_t{1'300'000});
    append_all<std::int16_t>(log.out, {0, 0, 9000});
    log.out.push_back(active);
    RecordingSink sink;
    (void)read_dataflash(log.out, sink);
    return sink.of_port("attitude").at(0).line.value("heading_std_rad", 0.0);
  };
  EXPECT_NEAR(stated('\3'), 0.04, 1e-6);
  EXPECT_NEAR(stated('\2'), 10 * 3.14159265358979 / 180, 1e-9) << "the second estimator logs no variances";
}

TEST(DataFlash, ReadsEachMessageInUnitsOfNavcal) {
  RecordingSink sink;
  const auto findings = read_dataflash(small_log(), sink);
  EXPECT_FALSE(findings.cut_at);
  EXPECT_FALSE(findings.times_are_utc);
  ASSERT_EQ(sink.of_port("imu").size(), 1U);
  ASSERT_EQ(sink.of_port("imu2").size(), 1U);
  const auto imu = sink.of_port("imu")[0];
  EXPECT_EQ(imu.message, "IMU[0]");
  EXPECT_EQ(imu.time_ns, 1'000'000'000);
  expect_vector(imu.line["rate_rad_s"], 0.5, -0.25, 0.125);
  expect_vector(imu.line["specific_force_m_s2"], 0.5, 1, -9.75);
  expect_vector(sink.of_port("compass").at(0).line["field_body_uT"], 20, -5, 43);
  const auto gps = sink.of_port("gps").at(0);
  EXPECT_EQ(gps.line["fix"], "3d");
  EXPECT_NEAR(gps.line["lat"].get<double>(), 47.5000001, 1e-12);
  EXPECT_NEAR(gps.line["lon"].get<double>(), -122.5, 1e-12);
  EXPECT_NEAR(gps.line["height_msl_m"].get<double>(), 12.34, 1e-9);
  EXPECT_NEAR(gps.line["course_rad"].get<double>(), 3.14159265358979 / 2, 1e-9);
  EXPECT_EQ(gps.line["climb_m_s"], 0.5) << "VZ is positive downwards";
  EXPECT_NEAR(gps.line["dop"].get<double>(), 0.85, 1e-9);
  EXPECT_EQ(gps.line["tracked"], 11);
  // Week 2300 begins at midnight of 2024-02-04; 302400.25 s later is the noon of Wednesday, less 18 leap seconds.
  EXPECT_EQ(gps.utc_ns, 1'707'307'182'250'000'000);
  EXPECT_EQ(sink.utcs.at(0), std::pair(std::int64_t{1'250'000'000}, std::int64_t{1'707'307'182'250'000'000}));
  const auto attitude = sink.of_port("attitude").at(0);
  EXPECT_NEAR(attitude.line["heading_rad"].get<double>(), 3.14159265358979, 1e-9);
  EXPECT_NEAR(attitude.line["pitch_rad"].get<double>(), 3 * 3.14159265358979 / 180, 1e-9);
  EXPECT_NEAR(attitude.line["roll_rad"].get<double>(), -1.5 * 3.14159265358979 / 180, 1e-9);
  EXPECT_EQ(sink.of_port("battery").at(0).line["current_A"], 2.25);
  const auto outputs = sink.of_port("motor");
  ASSERT_EQ(outputs.size(), 2U) << "an output of zero is not in use";
  EXPECT_EQ(outputs[1].line["quantity"], "output3");
  EXPECT_EQ(outputs[1].line["value"], 1900);
}

TEST(DataFlash, DepthIsThatOfThePrimaryBarometerOfASubmarine) {
  RecordingSink sink;
  (void)read_dataflash(small_log(), sink);
  const auto depth = sink.of_port("depth").at(0);
  EXPECT_EQ(depth.message, "BARO[1]");
  EXPECT_EQ(depth.line["depth_m"], 3.5);
  EXPECT_EQ(depth.line["pressure_Pa"], 135'000);
  EXPECT_EQ(depth.line["temperature_C"], 18.5);
  EXPECT_FALSE(sink.of_port("baro").at(0).line.contains("depth_m"));
}

TEST(DataFlash, OldLogsWithoutUnitsAndWithNumberedNames) {
  DataFlashWriter log;
  log.format(10, 3 + 8 + 6, "MAG2", "Qhhh", "TimeUS,MagX,MagY,MagZ");
  log.head(10);
  append_number(log.out, std::uint64_t{7});
  append_all<std::int16_t>(log.out, {100, 0, -100});
  RecordingSink sink;
  (void)read_dataflash(log.out, sink);
  expect_vector(sink.of_port("compass2").at(0).line["field_body_uT"], 10, 0, -10);
}

/// Fields of two compasses, whose offsets and motor fields stand beside them, and then the parameters of the
/// second.
std::string calibrated_log(const std::string& without) {
  DataFlashWriter log;
  log.format(11, 3 + 8 + 1 + 18, "MAG", "QBhhhhhhhhh", "TimeUS,I,MagX,MagY,MagZ,OfsX,OfsY,OfsZ,MOX,MOY,MOZ");
  log.format(18, 3 + 8 + 16 + 4, "PARM", "QNf", "TimeUS,Name,Value");
  for (const char unit : {'\0', '\1'}) {
    log.head(11);
    append_number(log.out, std::uint64_t{7});
    log.out.push_back(unit);
    append_all<std::int16_t>(log.out, {410, -200, 630, 10, -20, 30, 10, 0, -10});
  }
  for (const std::string& name : instruments::AutopilotCompass::names(1)) {
    if (name == without) continue;
    log.head(18);
    append_number(log.out, std::uint64_t{8});
    log.text(name, 16);
    append_number(log.out, name == "COMPASS_DIA2_X"                                           ? 2.0F
                           : name.find("DIA") != std::string::npos || name == "COMPASS_MOTCT" ? 1.0F
                           : name.find("MOT2") != std::string::npos                           ? 5.0F
                                                                                              : 0.0F);
  }
  return log.out;
}

TEST(DataFlash, TheCalibrationOfTheAutopilotIsUndoneWhereItIsKnown) {
  const auto fields = [](const std::string& log, bool undoes) {
    RecordingSink sink;
    MotorChannels none;
    EXPECT_TRUE(read_dataflash(log, sink, none, undoes).has_corrected_fields) << "of the first compass at least";
    expect_vector(sink.of_port("compass").at(0).line["field_body_uT"], 41, -20, 63);
    return sink.of_port("compass2").at(0).line["field_body_uT"];
  };
  // X: (410 - 10) / 2 - 10; Y: -200 - 0 + 20; Z: 630 + 10 - 30, in mGauss.
  expect_vector(fields(calibrated_log(""), true), 19, -18, 61);
  expect_vector(fields(calibrated_log("COMPASS_DIA2_Y"), true), 41, -20, 63);
  expect_vector(fields(calibrated_log(""), false), 41, -20, 63);
}

TEST(DataFlash, EverySampleIsInTheLogOrCountedAsLeft) {
  const auto written = testing::expect_counts_agree("dataflash", small_log());
  EXPECT_GE(written.at("compass"), 1U);
  EXPECT_GE(written.at("depth"), 1U);
}

// Before TimeUS, TimeMS of a GPS message was the time of the week, and the time since boot was T, where there was
// one.
TEST(DataFlash, TheTimeOfTheWeekOfOldLogsIsNoTimeSinceBoot) {
  for (const bool has_boot_time : {true, false}) {
    DataFlashWriter log;
    log.format(10, has_boot_time ? 22 : 18, "GPS", has_boot_time ? "BIHLLI" : "BIHLL",
               has_boot_time ? "Status,TimeMS,Week,Lat,Lng,T" : "Status,TimeMS,Week,Lat,Lng");
    log.head(10);
    log.out += '\x03';
    append_number(log.out, std::uint32_t{259'200'000});
    append_number(log.out, std::uint16_t{1773});
    append_all<std::int32_t>(log.out, {475'000'000, -1'225'000'000});
    if (has_boot_time) append_number(log.out, std::uint32_t{90'000});
    RecordingSink sink;
    (void)read_dataflash(log.out, sink);
    if (!has_boot_time) {
      EXPECT_EQ(sink.left_counts["GPS (no time)"], 1);
      continue;
    }
    ASSERT_EQ(sink.samples.size(), 1U);
    EXPECT_EQ(sink.samples[0].time_ns, 90'000'000'000);
    EXPECT_EQ(sink.samples[0].utc_ns, 1'388'534'384'000'000'000) << "2014-01-01 less 16 leap seconds";
  }
}

TEST(DataFlash, UnitsThatContradictAreTold) {
  DataFlashWriter log;
  log.units_tables();
  log.format(11, 3 + 8 + 6, "MAG", "Qhhh", "TimeUS,MagX,MagY,MagZ");
  log.unit('P', "Pa");
  log.units_of(11, "sPPP", "F---");
  log.head(11);
  append_number(log.out, std::uint64_t{7});
  log.out += "abcdef";
  RecordingSink sink;
  (void)read_dataflash(log.out, sink);
  EXPECT_TRUE(sink.samples.empty());
  EXPECT_EQ(sink.left_counts.begin()->first, "MAG (unit \"Pa\" of MagZ is none of a magnetic field)");
}

TEST(DataFlash, DamageIsPassedOverAndACutIsReported) {
  const std::string log = small_log();
  RecordingSink sink;
  const std::size_t middle = log.find("ArduSub") + 64;
  const auto findings = read_dataflash(log.substr(0, middle) + "garbage" + log.substr(middle), sink);
  EXPECT_EQ(findings.damaged_bytes, 7U);
  EXPECT_EQ(sink.of_port("gps").size(), 1U);
  RecordingSink cut_sink;
  const auto cut = read_dataflash(log.substr(0, log.size() - 5), cut_sink);
  EXPECT_EQ(cut.cut_at, log.size() - (3 + 8 + 1 + 8 + 2));
}

TEST(DataFlash, NoCutAndNoDamageBringsItDown) {
  testing::expect_robust(small_log(),
                         [](const std::string& file, ImportSink& sink) { return read_dataflash(file, sink); });
}

TEST(DataFlash, LeapSecondsByDate) {
  EXPECT_EQ(utc_of_gps_week(0, 0) / 1'000'000'000, 315'964'800 - 13) << "before 2006 those of 1999";
  EXPECT_EQ(utc_of_gps_week(1930, 18'000), 1'483'228'800'000'000'000) << "the first second of 2017 in UTC";
  EXPECT_EQ(utc_of_gps_week(1930, 17'000), 1'483'228'800'000'000'000)
      << "the leap second has no number of its own";
  EXPECT_EQ(utc_of_gps_week(1930, 16'000), 1'483'228'799'000'000'000);
}

// Counts of an independent reading; tests/cli/check_dataflash.py compares the values.
TEST(DataFlash, CaptureOfASubmarine) {
  const auto capture = protocols::test::shared_capture("ardusub/small.BIN");
  if (capture.empty()) GTEST_SKIP() << "the capture is not here";
  const std::string bytes(capture.begin(), capture.end());
  ASSERT_TRUE(is_dataflash(bytes));
  RecordingSink sink;
  const auto findings = read_dataflash(bytes, sink);
  EXPECT_FALSE(findings.cut_at);
  EXPECT_EQ(findings.damaged_bytes, 0U);
  EXPECT_EQ(sink.of_port("imu").size(), 594U);
  EXPECT_EQ(sink.of_port("compass").size(), 237U);
  EXPECT_EQ(sink.of_port("compass2").size(), 237U);
  EXPECT_EQ(sink.of_port("depth").size(), 237U);
  EXPECT_EQ(sink.of_port("baro").size(), 237U);
  EXPECT_EQ(sink.of_port("attitude").size(), 237U);
  EXPECT_EQ(sink.of_port("battery").size(), 237U);
  EXPECT_EQ(sink.of_port("motor").size(), 237U * 8);
  EXPECT_EQ(sink.left_counts["XKF1"], 237);
  // MAG -140, 63, 900 less the COMPASS_OFS of the log, floats.
  expect_vector(sink.of_port("compass")[0].line["field_body_uT"], -14.0 + 0.1 * 40.32841110229492,
                6.3 - 0.1 * 251.2924041748047, 90.0 - 0.1 * 363.9378967285156);
}

TEST(DataFlash, MappedOutputsMoveShaftAndFinsAndTheOthersStayPulses) {
  DataFlashWriter log;
  log.format(18, 3 + 8 + 16 + 4, "PARM", "QNf", "TimeUS,Name,Value");
  for (const auto& [name, value] : {std::pair{"SERVO1_FUNCTION", 70.0F}, std::pair{"SERVO3_FUNCTION", 21.0F}}) {
    log.head(18);
    append_number(log.out, std::uint64_t{1});
    log.text(name, 16);
    append_number(log.out, value);
  }
  const std::string plain = log.out + small_log();
  auto channels = testing::pulses_of("RCOU.C1", "RCOU.C3");
  RecordingSink sink;
  const auto findings = read_dataflash(plain, sink, channels);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_EQ(findings.remarks[0], "outputs by the parameters of the vehicle: 1 throttle, 3 rudder");
  const auto motor = sink.of_port("motor");
  ASSERT_EQ(motor.size(), 1U) << "both outputs in use are mapped";
  EXPECT_EQ(motor[0].line["class"], "MOTOR");
  EXPECT_EQ(motor[0].line["rpm_commanded"], 0);
  EXPECT_NEAR(motor[0].line["fins_rad"][0].get<double>(), 20 * 3.14159265358979 / 180, 1e-12);
  EXPECT_EQ(motor[0].time_ns, 1'500'000'000);
  // Any column serves, of messages with instances by their number, and of messages that are not taken.
  auto others = MotorChannels(config::parse_channel_map(
      "[column.\"BAT[0].Curr\"]\nmeaning = \"motor_current\"\n[column.\"RCOU.C1\"]\nmeaning = \"rpm\"\n", "map"));
  RecordingSink more;
  (void)read_dataflash(small_log(), more, others);
  ASSERT_EQ(more.of_port("motor").size(), 3U);
  EXPECT_EQ(more.of_port("motor")[0].line["current_A"], 2.25);
  EXPECT_EQ(more.of_port("motor")[1].line["rpm"], 1500);
  EXPECT_EQ(more.of_port("motor")[2].line["quantity"], "output3");
  EXPECT_EQ(more.of_port("battery").size(), 1U);
}

}  // namespace
}  // namespace navcal::analysis
