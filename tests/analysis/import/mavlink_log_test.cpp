// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "analysis/import/log_readers.h"
#include "config/load.h"
#include "instruments/autopilot_compass.h"
#include "instruments/sample_fields.h"
#include "protocols/crc16.h"
#include "protocols/mavlink.h"
#include "tests/analysis/import/channel_map.h"
#include "tests/analysis/import/counts_agree.h"
#include "tests/analysis/import/recording_sink.h"
#include "tests/analysis/import/without_channels.h"
#include "tests/instruments/collector.h"

namespace navcal::analysis {
namespace {

using testing::append_number;
using testing::expect_vector;
using testing::RecordingSink;

constexpr std::uint64_t kStart_us = 1'700'000'000'000'000;

template <class... Values>
std::string payload_of(Values... values) {
  std::string payload;
  (append_number(payload, values), ...);
  return payload;
}

std::uint16_t sum_of(const std::string& bytes) {
  return protocols::crc16_mcrf4xx({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

/// One entry of a telemetry log: time, and a frame of version 1 or 2.
std::string entry(std::uint64_t time_us, std::uint32_t id, std::string payload, std::uint8_t crc_extra,
                  bool is_second, std::uint8_t system = 1) {
  std::string time;
  for (int i = 7; i >= 0; --i) time.push_back(static_cast<char>(time_us >> (8 * i) & 0xFF));
  if (is_second) {
    while (payload.size() > 1 && payload.back() == '\0') payload.pop_back();
  }
  std::string frame(1, static_cast<char>(payload.size()));
  if (is_second) frame += std::string(2, '\0');
  frame += std::string(1, '\x05') + static_cast<char>(system) + '\x01';
  frame.push_back(static_cast<char>(id & 0xFF));
  if (is_second) {
    frame.push_back(static_cast<char>(id >> 8 & 0xFF));
    frame.push_back(static_cast<char>(id >> 16));
  }
  frame += payload;
  append_number(frame, sum_of(frame + static_cast<char>(crc_extra)));
  return time + (is_second ? '\xFD' : '\xFE') + frame;
}

std::string vehicle() {
  return entry(kStart_us, 0,
               payload_of(std::uint32_t{0}, std::uint8_t{12}, std::uint8_t{3}, std::uint8_t{0}, std::uint8_t{4},
                          std::uint8_t{3}),
               50, true);
}

std::string small_tlog(bool is_second) {
  std::string log = entry(kStart_us, 0,
                          payload_of(std::uint32_t{0}, std::uint8_t{12}, std::uint8_t{3}, std::uint8_t{0},
                                     std::uint8_t{4}, std::uint8_t{3}),
                          50, is_second);
  const auto i16 = [](int value) { return static_cast<std::int16_t>(value); };
  log += entry(kStart_us + 1000, 116,
               payload_of(std::uint32_t{5}, i16(100), i16(-200), i16(-1000), i16(500), i16(-250), i16(125),
                          i16(200), i16(-50), i16(430)),
               76, is_second);
  log += entry(kStart_us + 2000, 24,
               payload_of(std::uint64_t{9}, std::int32_t{475'000'000}, std::int32_t{-1'225'000'000},
                          std::int32_t{12'500}, std::uint16_t{85}, std::uint16_t{65535}, std::uint16_t{150},
                          std::uint16_t{9000}, std::uint8_t{3}, std::uint8_t{11}),
               24, is_second);
  log += entry(kStart_us + 3000, 30, payload_of(std::uint32_t{5}, -0.25F, 0.125F, -1.5F, 0.0F, 0.0F, 0.0F), 39,
               is_second);
  log += entry(kStart_us + 4000, 137, payload_of(std::uint32_t{5}, 1350.0F, 0.0F, i16(1850)), 195, is_second);
  log += entry(kStart_us + 5000, 1,
               payload_of(std::uint32_t{0}, std::uint32_t{0}, std::uint32_t{0}, std::uint16_t{0},
                          std::uint16_t{15500}, i16(225), std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0},
                          std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint8_t{90}),
               124, is_second);
  log += entry(
      kStart_us + 6000, 36,
      payload_of(std::uint32_t{5}, std::uint16_t{1500}, std::uint16_t{0}, std::uint16_t{1900}, std::uint16_t{0},
                 std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint8_t{0}),
      222, is_second);
  log += entry(kStart_us + 7000, 30, payload_of(std::uint32_t{5}, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F), 39,
               is_second, 9);
  return log + entry(kStart_us + 8000, 2, payload_of(std::uint64_t{kStart_us - 10'000'000}, std::uint32_t{9}), 137,
                     is_second);
}

TEST(MavlinkLog, ReadsEachMessageInUnitsOfNavcal) {
  for (const bool is_second : {false, true}) {
    ASSERT_TRUE(is_mavlink_log(small_tlog(is_second)));
    RecordingSink sink;
    const auto findings = read_mavlink_log(small_tlog(is_second), sink);
    EXPECT_TRUE(findings.times_are_utc);
    EXPECT_EQ(findings.damaged_bytes, 0U);
    const auto imu = sink.of_port("imu2").at(0);
    EXPECT_EQ(imu.time_ns, static_cast<std::int64_t>(kStart_us + 1000) * 1000);
    expect_vector(imu.line["rate_rad_s"], 0.5, -0.25, 0.125);
    expect_vector(imu.line["specific_force_m_s2"], 0.980665, -1.96133, -9.80665);
    expect_vector(sink.of_port("compass2").at(0).line["field_body_uT"], 20, -5, 43);
    const auto gps = sink.of_port("gps").at(0);
    EXPECT_NEAR(gps.line["lat"].get<double>(), 47.5, 1e-12);
    EXPECT_NEAR(gps.line["height_msl_m"].get<double>(), 12.5, 1e-12);
    EXPECT_NEAR(gps.line["speed_m_s"].get<double>(), 1.5, 1e-12);
    EXPECT_FALSE(gps.line.contains("position_std_m"));
    const auto attitude = sink.of_port("attitude");
    ASSERT_EQ(attitude.size(), 1U) << "of the first vehicle";
    EXPECT_NEAR(attitude[0].line["heading_rad"].get<double>(), 2 * 3.14159265358979 - 1.5, 1e-9);
    EXPECT_EQ(attitude[0].line["pitch_rad"], 0.125);
    EXPECT_EQ(attitude[0].line["heading_is_true"], true);
    EXPECT_NEAR(attitude[0].line["heading_std_rad"].get<double>(), 10 * 3.14159265358979 / 180, 1e-9);
    EXPECT_EQ(sink.of_port("baro2").at(0).line["pressure_Pa"], 135'000);
    EXPECT_NEAR(sink.of_port("battery").at(0).line["voltage_V"].get<double>(), 15.5, 1e-12);
    EXPECT_NEAR(sink.of_port("battery").at(0).line["current_A"].get<double>(), 2.25, 1e-12);
    ASSERT_EQ(sink.of_port("motor").size(), 2U);
    EXPECT_EQ(sink.of_port("motor")[1].line["quantity"], "output3");
    EXPECT_EQ(sink.left_counts["HEARTBEAT"], 1);
    EXPECT_EQ(sink.left_counts["ATTITUDE (of system 9)"], 1);
    ASSERT_EQ(findings.remarks.size(), 1U);
    EXPECT_NE(findings.remarks[0].find("10.0 s ahead"), std::string::npos) << findings.remarks[0];
    EXPECT_TRUE(findings.has_corrected_fields) << "the log lacks the parameters";
  }
}

TEST(MavlinkLog, TheCalibrationOfTheAutopilotIsUndoneFromTheFirstFieldOn) {
  std::string log = small_tlog(true);
  for (std::string name : instruments::AutopilotCompass::names(1)) {
    const float value = name.find("DIA") != std::string::npos ? 1.0F : name == "COMPASS_OFS2_Y" ? -70.0F : 0.0F;
    name.resize(16);
    log += entry(kStart_us + 9'000'000, 22,
                 payload_of(value, std::uint16_t{900}, std::uint16_t{65535}) + name + '\x09', 220, true);
  }
  RecordingSink sink;
  const auto findings = read_mavlink_log(log, sink);
  expect_vector(sink.of_port("compass2").at(0).line["field_body_uT"], 20, 2, 43);
  EXPECT_FALSE(findings.has_corrected_fields);
  RecordingSink kept;
  MotorChannels none;
  const auto of_kept = read_mavlink_log(log, kept, none, false);
  expect_vector(kept.of_port("compass2").at(0).line["field_body_uT"], 20, -5, 43);
  EXPECT_TRUE(of_kept.has_corrected_fields);
}

/// Compares the members that both have as numbers; those of a fix in degrees are left.
template <class S>
void expect_same(const S& live, const nlohmann::json& line) {
  EXPECT_EQ(line["class"], instruments::kKind<S>.class_name);
  instruments::for_each_field<S>([&](const auto& field) {
    const auto* const member = instruments::member_of(live, field);
    if (member == nullptr || field.quantity.form == instruments::Form::degrees) return;
    using T = std::remove_cvref_t<decltype(*member)>;
    if constexpr (std::is_same_v<T, std::optional<double>>) {
      EXPECT_EQ(line.contains(field.key), member->has_value()) << field.key;
      if (*member) {
        EXPECT_NEAR(line[field.key].template get<double>(), **member, 1e-9) << field.key;
      }
    } else if constexpr (std::is_same_v<T, std::optional<instruments::Vector3>>) {
      ASSERT_EQ(line.contains(field.key), member->has_value()) << field.key;
      if (*member) expect_vector(line[field.key], (**member)[0], (**member)[1], (**member)[2]);
    } else if constexpr (std::is_same_v<T, bool>) {
      EXPECT_EQ(line.value(field.key, false), *member) << field.key;
    }
  });
}

TEST(MavlinkLog, TheSamplesAreThoseOfALivePort) {
  std::string parameters, log = small_tlog(true);
  for (std::string name : instruments::AutopilotCompass::names(1)) {
    const float value = name.find("DIA") != std::string::npos ? 1.0F : 0.0F;
    name.resize(16);
    parameters += entry(kStart_us, 22, payload_of(value, std::uint16_t{900}, std::uint16_t{65535}) + name + '\x09',
                        220, true);
  }
  log = vehicle() + parameters + log;
  RecordingSink sink;
  (void)read_mavlink_log(log, sink);
  auto settings = config::default_port("rov", protocols::Protocol::mavlink, 4'000'000);
  settings.inertial_unit = 2;
  instruments::Collector live(settings);
  live.feed<protocols::mavlink::Parser>(log);  // the times between the frames are none
  ASSERT_EQ(live.measurements.size(), sink.samples.size());
  for (std::size_t i = 0; i < sink.samples.size(); ++i)
    std::visit([&](const auto& value) { expect_same(value, sink.samples[i].line); }, live.measurements[i].value);
}

// Bytes that pymavlink's CRC gives for the heartbeat of the MAVLink guide: X.25 of "123456789" is 0x6F91 before
// its complement, which MAVLink leaves out.
TEST(MavlinkLog, TheChecksumIsThatOfTheSpecification) { EXPECT_EQ(sum_of("123456789"), 0x6F91); }

TEST(MavlinkLog, EverySampleIsInTheLogOrCountedAsLeft) {
  const auto written = testing::expect_counts_agree("tlog", small_tlog(true));
  EXPECT_EQ(written.at("imu2"), 1U);
  EXPECT_EQ(written.at("compass2"), 1U) << "of the same message";
  EXPECT_EQ(written.at("motor"), 2U);
}

TEST(MavlinkLog, AFrameWithADamagedByteIsPassedOver) {
  std::string log = vehicle() + small_tlog(true);
  log[vehicle().size() + 8 + 12] = '\x55';
  RecordingSink sink;
  const auto findings = read_mavlink_log(log, sink);
  EXPECT_GT(findings.damaged_bytes, 0U);
  EXPECT_EQ(sink.of_port("imu2").size(), 1U) << "the one after it";
}

TEST(MavlinkLog, NoCutAndNoDamageBringsItDown) {
  testing::expect_robust(small_tlog(true),
                         [](const std::string& file, ImportSink& sink) { return read_mavlink_log(file, sink); });
}

TEST(MavlinkLog, MappedOutputsMoveShaftAndFins) {
  for (const bool is_second : {false, true}) {
    auto channels = testing::pulses_of("SERVO_OUTPUT_RAW.servo1_raw", "SERVO_OUTPUT_RAW.servo3_raw");
    RecordingSink sink;
    std::string name = "SERVO3_FUNCTION";
    name.resize(16);
    std::string parameter = payload_of(21.0F, std::uint16_t{9}, std::uint16_t{3}) + name + '\x09';
    const auto findings = read_mavlink_log(
        small_tlog(is_second) + entry(kStart_us + 8500, 22, parameter, 220, is_second), sink, channels);
    EXPECT_EQ(findings.remarks.back(), "outputs by the parameters of the vehicle: 3 rudder");
    const auto motor = sink.of_port("motor");
    ASSERT_EQ(motor.size(), 1U);
    EXPECT_EQ(motor[0].message, "SERVO_OUTPUT_RAW by the map");
    EXPECT_EQ(motor[0].line["rpm_commanded"], 0);
    EXPECT_NEAR(motor[0].line["fins_rad"][0].get<double>(), 20 * 3.14159265358979 / 180, 1e-12);
  }
}

TEST(MavlinkLog, OutputsBehindTheEighthAreThoseOfVersion2) {
  std::string payload = payload_of(std::uint32_t{5});
  for (int i = 0; i < 8; ++i) append_number(payload, std::uint16_t{0});
  payload += '\0';
  append_number(payload, std::uint16_t{1234});
  RecordingSink sink;
  (void)read_mavlink_log(small_tlog(true) + entry(kStart_us + 9000, 36, payload, 222, true), sink);
  EXPECT_EQ(sink.of_port("motor").back().line["quantity"], "output9");
  EXPECT_EQ(sink.of_port("motor").back().line["value"], 1234);
}

std::string distance(std::uint16_t cm, std::uint8_t orientation, std::uint8_t quality) {
  return payload_of(std::uint32_t{700}, std::uint16_t{30}, std::uint16_t{5000}, cm, std::uint8_t{2},
                    std::uint8_t{0}, orientation, std::uint8_t{4}) +
         std::string(24, '\0') + static_cast<char>(quality);
}

TEST(MavlinkLog, EchoesAreThoseThatLookDownAndAreValid) {
  RecordingSink sink;
  (void)read_mavlink_log(vehicle() + entry(kStart_us, 132, distance(250, 25, 90), 85, true) +
                             entry(kStart_us, 132, distance(260, 24, 90), 85, true) +
                             entry(kStart_us, 132, distance(270, 25, 1), 85, true) +
                             entry(kStart_us, 132, distance(6000, 25, 90), 85, true) +
                             entry(kStart_us, 173, payload_of(9.0F, 0.0F), 83, true),
                         sink);
  const auto echoes = sink.of_port("altimeter");
  ASSERT_EQ(echoes.size(), 1U);
  EXPECT_NEAR(echoes[0].line["altitude_m"].get<double>(), 2.5, 1e-12);
  EXPECT_NEAR(echoes[0].line["altitude_std_m"].get<double>(), 0.02, 1e-12);
  EXPECT_EQ(sink.left_counts["RANGEFINDER"], 1);
}

TEST(MavlinkLog, ARangefinderServesWithoutADistanceSensor) {
  RecordingSink sink;
  (void)read_mavlink_log(vehicle() + entry(kStart_us, 173, payload_of(9.0F, 0.0F), 83, true), sink);
  EXPECT_EQ(sink.of_port("altimeter").at(0).line["altitude_m"], 9);
}

TEST(MavlinkLog, ABatteryIsTheSumOfItsCellsAndReplacesTheSystemStatus) {
  std::string cells =
      payload_of(std::int32_t{0}, std::int32_t{0}, std::int16_t{0}, std::uint16_t{65534}, std::uint16_t{1466});
  for (int i = 0; i < 8; ++i) append_number(cells, std::uint16_t{65535});
  append_number(cells, std::int16_t{-1});
  RecordingSink sink;
  const std::string status =
      payload_of(std::uint64_t{0}, std::uint32_t{0}, std::uint16_t{0}, std::uint16_t{15500});
  (void)read_mavlink_log(vehicle() + entry(kStart_us, 1, status, 124, true) +
                             entry(kStart_us, 147, cells, 154, true) + entry(kStart_us, 1, status, 124, true),
                         sink);
  const auto battery = sink.of_port("battery");
  ASSERT_EQ(battery.size(), 2U);
  EXPECT_NEAR(battery[1].line["voltage_V"].get<double>(), 67, 1e-12);
  EXPECT_FALSE(battery[1].line.contains("current_A"));
  EXPECT_EQ(sink.left_counts["SYS_STATUS"], 1);
}

std::string high_resolution(std::uint64_t time_us, float field, std::uint16_t updated) {
  return payload_of(time_us, 0.5F, 0.0F, -9.8F, 0.25F, 0.0F, 0.0F, field, 0.0F, 0.0F, 1013.25F, 0.0F, 0.0F, 21.5F,
                    updated) +
         std::string(1, '\0');
}

TEST(MavlinkLog, OfHighResolutionIsTakenWhatIsNew) {
  const std::string raw =
      payload_of(std::uint64_t{1'100'000}, std::int16_t{7}, std::uint64_t{0}, std::uint64_t{0});
  RecordingSink sink;
  (void)read_mavlink_log(vehicle() + entry(kStart_us, 105, high_resolution(1'000'000, 0.25F, 0xFFFF), 93, true) +
                             entry(kStart_us, 105, high_resolution(1'020'000, 250'000.0F, 0x1FF), 93, true) +
                             entry(kStart_us, 105, high_resolution(1'040'000, 0.3F, 0x3F), 93, true) +
                             entry(kStart_us, 27, raw, 144, true),
                         sink);
  ASSERT_EQ(sink.of_port("imu").size(), 3U);
  EXPECT_EQ(sink.left_counts["RAW_IMU"], 1) << "the same unit with less resolution";
  expect_vector(sink.of_port("imu")[0].line["specific_force_m_s2"], 0.5, 0, static_cast<double>(-9.8F));
  const auto compass = sink.of_port("compass");
  ASSERT_EQ(compass.size(), 1U) << "microgauss for gauss is the same field";
  expect_vector(compass[0].line["field_body_uT"], 25, 0, 0);
  ASSERT_EQ(sink.of_port("baro4").size(), 1U);
  EXPECT_NEAR(sink.of_port("baro4")[0].line["pressure_Pa"].get<double>(), 101'325, 0.01);
}

TEST(MavlinkLog, AFieldThatIsRepeatedIsTakenOnce) {
  std::string log = vehicle();
  for (int i = 0; i < 50; ++i) {
    const auto field = static_cast<std::int16_t>(100 + i / 5);
    log += entry(kStart_us + 20'000 * static_cast<unsigned>(i), 116,
                 payload_of(static_cast<std::uint32_t>(5000 + 20 * i), std::uint64_t{1}, std::uint32_t{0}, field,
                            std::int16_t{0}, std::int16_t{0}),
                 76, true);
  }
  RecordingSink sink;
  (void)read_mavlink_log(log, sink);
  EXPECT_EQ(sink.of_port("imu2").size(), 50U);
  EXPECT_EQ(sink.of_port("compass2").size(), 10U);
}

TEST(MavlinkLog, NothingIsReadOfAVehicleWithoutAnAutopilot) {
  const std::string pressure = payload_of(std::uint32_t{5}, 1350.0F, 0.0F, std::int16_t{1850});
  RecordingSink sink;
  (void)read_mavlink_log(
      entry(kStart_us, 137, pressure, 195, true) + vehicle() +
          entry(kStart_us, 137, payload_of(std::uint32_t{5}, 0.0F, 0.0F, std::int16_t{1850}), 195, true),
      sink);
  EXPECT_TRUE(sink.of_port("baro2").empty());
  EXPECT_EQ(sink.of_port("sensors").at(0).line["value"], 18.5) << "a thermometer has no pressure";
}

}  // namespace
}  // namespace navcal::analysis
