// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "analysis/import/log_readers.h"
#include "tests/analysis/import/channel_map.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"
#include "tests/analysis/import/without_channels.h"

namespace navcal::analysis {
namespace {

using testing::append_number;
using testing::expect_vector;
using testing::RecordingSink;

/// Writes a ULog by its specification (PX4, "ULog File Format").
class UlogWriter {
 public:
  UlogWriter() {
    out = std::string("ULog\x01\x12\x35\x01", 8);
    append_number(out, std::uint64_t{1'000'000});
    message('B', std::string(40, '\0'));
  }
  void message(char type, const std::string& content) {
    append_number(out, static_cast<std::uint16_t>(content.size()));
    out.push_back(type);
    out += content;
  }
  void subscribe(std::uint16_t id, std::uint8_t instance, const std::string& name) {
    std::string content(1, static_cast<char>(instance));
    append_number(content, id);
    message('A', content + name);
  }
  template <class... Values>
  void data(std::uint16_t id, std::uint64_t time_us, Values... values) {
    std::string content;
    append_number(content, id);
    append_number(content, time_us);
    (append_number(content, values), ...);
    message('D', content);
  }
  std::string out;
};

std::string small_ulog() {
  UlogWriter log;
  log.message('F', "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;");
  log.message('F', "vehicle_magnetometer:uint64_t timestamp;uint64_t timestamp_sample;float[3] magnetometer_ga;");
  log.message('F',
              "vehicle_gps_position:uint64_t timestamp;uint64_t time_utc_usec;int32_t lat;int32_t lon;int32_t alt;"
              "float eph;float vel_m_s;uint8_t fix_type;uint8_t[3] _padding0;");
  log.message('F', "sensor_gps:uint64_t timestamp;double latitude_deg;");
  log.message('F', "vehicle_attitude:uint64_t timestamp;float[4] q;");
  log.message('F', "inner:uint16_t a;uint8_t[2] b;");
  log.message('F', "battery_status:uint64_t timestamp;inner[2] cells;float voltage_v;float current_a;");
  log.message('F', "actuator_outputs:uint64_t timestamp;uint32_t noutputs;float[4] output;");
  log.subscribe(0, 0, "sensor_combined");
  log.subscribe(1, 1, "vehicle_magnetometer");
  log.subscribe(2, 0, "vehicle_gps_position");
  log.subscribe(3, 0, "vehicle_attitude");
  log.subscribe(4, 0, "battery_status");
  log.subscribe(5, 0, "actuator_outputs");
  log.subscribe(6, 0, "sensor_gps");
  log.subscribe(7, 0, "vehicle_status");
  log.data(0, 2'000'000, 0.5F, -0.25F, 0.125F, 0.5F, 1.0F, -9.75F);
  log.data(1, 2'000'500, std::uint64_t{2'000'400}, 0.25F, -0.5F, 0.125F);
  log.data(2, 2'100'000, std::uint64_t{1'700'000'000'000'000}, std::int32_t{475'000'000},
           std::int32_t{-1'225'000'000}, std::int32_t{12'500}, 1.5F, 2.0F, std::uint8_t{3}, std::uint8_t{0},
           std::uint16_t{0});
  log.data(6, 2'100'000, 47.5);
  // A quarter turn to starboard, scalar first: east.
  log.data(3, 2'200'000, 0.70710678F, 0.0F, 0.0F, 0.70710678F);
  log.data(4, 2'300'000, std::uint64_t{0}, 15.5F, 2.25F);
  log.data(5, 2'400'000, std::uint32_t{2}, 1500.0F, 1600.0F, 0.0F, 0.0F);
  log.data(7, 2'400'000, 1.0F);
  log.message('O', std::string("\x32\x00", 2));
  return log.out;
}

TEST(Ulog, ReadsEachMessageInUnitsOfNavcal) {
  ASSERT_TRUE(is_ulog(small_ulog()));
  RecordingSink sink;
  const auto findings = read_ulog(small_ulog(), sink);
  EXPECT_FALSE(findings.cut_at);
  EXPECT_FALSE(findings.times_are_utc);
  const auto imu = sink.of_port("imu").at(0);
  EXPECT_EQ(imu.time_ns, 2'000'000'000);
  expect_vector(imu.line["rate_rad_s"], 0.5, -0.25, 0.125);
  expect_vector(imu.line["specific_force_m_s2"], 0.5, 1, -9.75);
  const auto compass = sink.of_port("compass2").at(0);
  EXPECT_EQ(compass.time_ns, 2'000'400'000) << "when it was sampled, not when it was published";
  expect_vector(compass.line["field_body_uT"], 25, -50, 12.5);
  const auto gps = sink.of_port("gps").at(0);
  EXPECT_NEAR(gps.line["lat"].get<double>(), 47.5, 1e-12);
  EXPECT_NEAR(gps.line["height_msl_m"].get<double>(), 12.5, 1e-12);
  EXPECT_EQ(gps.line["position_std_m"], 1.5);
  EXPECT_EQ(gps.utc_ns, 1'700'000'000'000'000'000);
  ASSERT_EQ(sink.utcs.size(), 1U);
  EXPECT_EQ(sink.of_port("gps").size(), 1U);
  EXPECT_EQ(sink.left_counts["sensor_gps (the same as vehicle_gps_position)"], 1);
  const auto attitude = sink.of_port("attitude").at(0);
  EXPECT_NEAR(attitude.line["heading_rad"].get<double>(), 3.14159265 / 2, 1e-6);
  EXPECT_NEAR(attitude.line["roll_rad"].get<double>(), 0, 1e-6);
  EXPECT_EQ(sink.of_port("battery").at(0).line["voltage_V"], 15.5) << "behind a nested format";
  ASSERT_EQ(sink.of_port("motor").size(), 2U);
  EXPECT_EQ(sink.of_port("motor")[1].line["value"], 1600);
  EXPECT_EQ(sink.left_counts["vehicle_status"], 1);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_EQ(findings.remarks[0], "1 dropouts of the logger, 50 ms in all");
}

TEST(Ulog, EverySampleIsInTheLogOrCountedAsLeft) {
  const auto written = testing::expect_counts_agree("ulog", small_ulog());
  EXPECT_EQ(written.at("imu"), 1U);
  EXPECT_EQ(written.at("motor"), 2U);
}

TEST(Ulog, ANewReceiverMessage) {
  UlogWriter log;
  log.message('F',
              "sensor_gps:uint64_t timestamp;double latitude_deg;double longitude_deg;double "
              "altitude_msl_m;uint8_t fix_type;");
  log.subscribe(0, 0, "sensor_gps");
  log.data(0, 5, 47.5, -122.5, 3.0, std::uint8_t{3});
  RecordingSink sink;
  (void)read_ulog(log.out, sink);
  EXPECT_EQ(sink.of_port("gps").at(0).line["lon"], -122.5);
}

TEST(Ulog, ACutIsReportedAtItsByte) {
  const std::string log = small_ulog();
  RecordingSink sink;
  EXPECT_EQ(read_ulog(log.substr(0, log.size() - 1), sink).cut_at, log.size() - 5);
}

TEST(Ulog, AFormatThatContainsItselfIsNoFormat) {
  UlogWriter log;
  log.message('F', "sensor_combined:uint64_t timestamp;sensor_combined again;");
  log.subscribe(0, 0, "sensor_combined");
  log.data(0, 5, 1.0F);
  RecordingSink sink;
  (void)read_ulog(log.out, sink);
  EXPECT_EQ(sink.left_counts["sensor_combined (no format)"], 1);
}

TEST(Ulog, NoCutAndNoDamageBringsItDown) {
  testing::expect_robust(small_ulog(),
                         [](const std::string& file, ImportSink& sink) { return read_ulog(file, sink); });
}

TEST(Ulog, CommandsAreSensorsUnlessTheMapNamesThem) {
  UlogWriter log;
  log.message('F', "actuator_outputs:uint64_t timestamp;uint32_t noutputs;float[4] output;");
  log.message('F', "actuator_motors:uint64_t timestamp;uint64_t timestamp_sample;float[3] control;");
  log.message('F', "actuator_servos:uint64_t timestamp;uint64_t timestamp_sample;float[2] control;");
  log.message('P', std::string(1, '\x16') + "int32_t PWM_MAIN_FUNC1" + std::string("\x65\0\0\0", 4));
  log.subscribe(0, 0, "actuator_outputs");
  log.subscribe(1, 0, "actuator_motors");
  log.subscribe(2, 0, "actuator_servos");
  log.data(0, 2'000'000, std::uint32_t{2}, 1500.0F, 1900.0F, 0.0F, 0.0F);
  log.data(1, 2'100'000, std::uint64_t{2'090'000}, 0.5F, NAN, NAN);
  log.data(2, 2'200'000, std::uint64_t{0}, -0.25F, 1.0F);
  RecordingSink plain;
  const auto findings = read_ulog(log.out, plain);
  ASSERT_EQ(findings.remarks.size(), 1U);
  EXPECT_EQ(findings.remarks[0], "outputs by the parameters of the vehicle: 1 motor 1");
  ASSERT_EQ(plain.samples.size(), 5U);
  EXPECT_EQ(plain.samples[2].line["quantity"], "motor1");
  EXPECT_EQ(plain.samples[2].time_ns, 2'090'000'000);
  EXPECT_EQ(plain.samples[4].line["quantity"], "servo2");
  EXPECT_EQ(plain.samples[4].line["value"], 1);
  auto channels = MotorChannels(config::parse_channel_map(
      "[column.\"actuator_motors.control[0]\"]\nmeaning = \"rpm_commanded\"\nscale = 1200\n"
      "[column.\"actuator_servos.control[1]\"]\nmeaning = \"fin_3\"\nunit = \"deg\"\nscale = 25\n",
      "map.toml"));
  RecordingSink sink;
  (void)read_ulog(log.out, sink, channels);
  ASSERT_EQ(sink.samples.size(), 5U);
  EXPECT_EQ(sink.samples[2].line["rpm_commanded"], 600);
  EXPECT_EQ(sink.samples[3].line["fins_rad"][2].get<double>(), 25 * 3.141592653589793 / 180);
  EXPECT_TRUE(sink.samples[3].line["fins_rad"][0].is_null());
  EXPECT_EQ(sink.samples[4].line["quantity"], "servo1");
  EXPECT_NO_THROW(channels.expect_all_found());
}

/// One field of (0.25, -0.5, 0.125) gauss, of the first compass, and its calibration with one parameter changed.
std::string calibrated_ulog(const std::string& changed = {}, float to = 0) {
  UlogWriter log;
  log.message('F', "vehicle_magnetometer:uint64_t timestamp;uint32_t device_id;float[3] magnetometer_ga;");
  const auto parameter = [&](const std::string& key, auto value) {
    if (key.ends_with(' ' + changed)) value = static_cast<decltype(value)>(to);
    std::string content = static_cast<char>(key.size()) + key;
    append_number(content, value);
    log.message('P', content);
  };
  for (const char axis : {'X', 'Y', 'Z'}) {
    const std::string of = std::string("float CAL_MAG0_") + axis;
    parameter(of + "OFF", axis == 'X' ? 0.0625F : -0.125F);
    parameter(of + "SCALE", axis == 'Y' ? 2.0F : 1.0F);
    parameter(of + "ODIAG", 0.0F);
  }
  for (const std::string name : {"CAL_MAG0_ROT", "SENS_BOARD_ROT", "CAL_MAG_COMP_TYP"})
    parameter("int32_t " + name, std::int32_t{0});
  parameter("int32_t CAL_MAG0_ID", std::int32_t{77});
  parameter("float SENS_BOARD_Y_OFF", 0.0F);
  log.subscribe(0, 0, "vehicle_magnetometer");
  log.data(0, 5, std::uint32_t{77}, 0.25F, -0.5F, 0.125F);
  return log.out;
}

TEST(Ulog, TheCalibrationOfTheAutopilotIsUndoneWhereItIsKnown) {
  const auto field = [](const std::string& log, bool is_undone, bool undoes = true) {
    RecordingSink sink;
    MotorChannels none;
    EXPECT_NE(read_ulog(log, sink, none, undoes).has_corrected_fields, is_undone);
    return sink.of_port("compass").at(0).line["field_body_uT"];
  };
  // D (measured - OFF), in gauss: X 0.25 + 0.0625, Y -0.5 / 2 - 0.125, Z 0.125 - 0.125.
  expect_vector(field(calibrated_ulog(), true), 31.25, -37.5, 0);
  expect_vector(field(calibrated_ulog("CAL_MAG0_ROT", -1), true), 31.25, -37.5, 0);
  expect_vector(field(calibrated_ulog(), false, false), 25, -50, 12.5);
  const std::vector<std::pair<std::string, float>> without{{"CAL_MAG0_ROT", 6.0F},     {"SENS_BOARD_ROT", 2.0F},
                                                           {"SENS_BOARD_Y_OFF", 1.0F}, {"CAL_MAG_COMP_TYP", 2.0F},
                                                           {"CAL_MAG0_ID", 78.0F},     {"CAL_MAG0_ZSCALE", 0.0F}};
  for (const auto& [name, value] : without)
    expect_vector(field(calibrated_ulog(name, value), false), 25, -50, 12.5);
}

TEST(Ulog, TheErrorThatTheEstimatorStatesOfItsHeadingGoesWithTheAttitude) {
  const auto stated = [](const std::string& name, const std::string& members, auto... values) {
    UlogWriter log;
    log.message('F', name + ":uint64_t timestamp;" + members);
    log.message('F', "vehicle_attitude:uint64_t timestamp;float[4] q;");
    log.subscribe(0, 0, name);
    log.subscribe(1, 0, "vehicle_attitude");
    log.data(0, 1'000'000, values...);
    log.data(1, 1'100'000, 1.0F, 0.0F, 0.0F, 0.0F);
    RecordingSink sink;
    (void)read_ulog(log.out, sink);
    EXPECT_EQ(sink.left_counts[name], 1);
    return sink.of_port("attitude").at(0).line.value("heading_std_rad", 0.0);
  };
  EXPECT_NEAR(stated("vehicle_local_position", "float heading_var;", 0.0025F), 0.05, 1e-6);
  EXPECT_EQ(stated("vehicle_local_position", "float heading_var;", NAN), 0);
  EXPECT_EQ(stated("vehicle_local_position", "float x;", 1.0F), 0);
  std::array<float, 24> variances{0.0003F, 1, 1, 0.0001F}, states{};
  EXPECT_NEAR(stated("estimator_states", "float[24] states;float[24] covariances;", states, variances), 0.04,
              1e-6);
  std::array<float, 25> more_states{};
  EXPECT_EQ(stated("estimator_states", "float[25] states;float[24] covariances;", more_states, variances), 0)
      << "variances of angles, not of a quaternion";
}

TEST(Ulog, EachTypeIsLaidOutOnceHoweverOftenItIsNested) {
  UlogWriter log;
  // A type without fields takes no bytes, so that no size ends the nesting.
  log.message('F', "t0:");
  for (int i = 1; i < 8; ++i) {
    std::string definition = fmt::format("t{}:", i);
    for (int k = 0; k < 900; ++k) definition += fmt::format("t{} f{};", i - 1, k);
    log.message('F', definition);
  }
  log.message('F', "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] accelerometer_m_s2;t7 nested;");
  log.message('F', "vehicle_magnetometer:uint64_t timestamp;vehicle_magnetometer own;float[3] magnetometer_ga;");
  log.subscribe(0, 0, "sensor_combined");
  log.subscribe(1, 0, "vehicle_magnetometer");
  log.data(0, 2'000'000, 0.5F, -0.25F, 0.125F, 0.5F, 1.0F, -9.75F);
  log.data(1, 2'000'000, 0.25F, -0.5F, 0.125F);
  RecordingSink sink;
  (void)read_ulog(log.out, sink);
  EXPECT_EQ(sink.samples.size(), 1U);
  EXPECT_EQ(sink.left_counts.count("vehicle_magnetometer (no format)"), 1U) << "it would contain itself";
}

}  // namespace
}  // namespace navcal::analysis
