// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "instruments/frame_clock.h"
#include "protocols/mip.h"
#include "tests/instruments/collector.h"
#include "tests/protocols/shared_capture.h"

namespace navcal::instruments {
namespace {

namespace mip = protocols::mip;
using Bytes = std::vector<std::uint8_t>;

/// Floats as the documentation writes them: most significant byte first.
Bytes wire(std::initializer_list<float> values) {
  Bytes bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  return bytes;
}
Bytes valid(Bytes bytes, bool is_valid = true) {
  bytes.push_back(0);
  bytes.push_back(is_valid ? 1 : 0);
  return bytes;
}
const Bytes kReference{0, 0, 0, 0x41, 0xD9, 0x19, 0x3B, 0x40};
constexpr std::int64_t kReference_ns = 0x41D9193B40;

struct MipReading {
  Collector collector{protocols::Protocol::mip};
  void feed(std::uint8_t set, const std::vector<mip::Field>& fields) {
    collector.feed<mip::Parser>(mip::encode_fields(set, fields));
  }
};

TEST(MipSensor, SensorDataInUnitsOfTheSystem) {
  MipReading reading;
  reading.feed(0x80, {{0xD5, kReference},
                      {0x04, wire({0.5F, 0, -1})},
                      {0x05, wire({0.25F, -0.5F, 1})},
                      {0x06, wire({0.2F, 0, 0.4F})},
                      {0x0C, wire({0.125F, -0.25F, -1})}});
  ASSERT_EQ(reading.collector.measurements.size(), 2U);
  const auto& first = reading.collector.measurements[0];
  EXPECT_TRUE(first.paces);
  EXPECT_EQ(first.device_time_ns, kReference_ns);
  const auto imu = std::get<ImuSample>(first.value);
  EXPECT_NEAR((*imu.specific_force_m_s2)[0], 4.903325, 1e-9);
  EXPECT_NEAR((*imu.specific_force_m_s2)[2], -9.80665, 1e-9) << "level and still";
  EXPECT_EQ(imu.rate_rad_s, (Vector3{0.25, -0.5, 1}));
  const auto& second = reading.collector.measurements[1];
  EXPECT_FALSE(second.paces);
  EXPECT_EQ(second.device_time_ns, kReference_ns);
  const auto compass = std::get<CompassSample>(second.value);
  EXPECT_NEAR((*compass.field_body_uT)[0], 20, 1e-5);
  EXPECT_NEAR((*compass.field_body_uT)[2], 40, 1e-5);
  EXPECT_DOUBLE_EQ(*compass.roll_rad, 0.125);
  EXPECT_DOUBLE_EQ(*compass.pitch_rad, -0.25);
  EXPECT_DOUBLE_EQ(*compass.heading_rad, 2 * std::numbers::pi - 1);
  EXPECT_FALSE(compass.heading_is_true);
}

TEST(MipSensor, TheFiltersHeadingIsTrueAndHasItsStatedErrors) {
  MipReading reading;
  reading.feed(0x82, {{0xD5, kReference},
                      {0x05, valid(wire({0.125F, -0.25F, 1}))},
                      {0x0A, valid(wire({0.0078125F, 0.015625F, 0.03125F}))},
                      {0x10, {0, 2, 0, 1, 0, 0}}});
  const auto compass = reading.collector.all<CompassSample>().at(0);
  EXPECT_DOUBLE_EQ(*compass.heading_rad, 1);
  EXPECT_TRUE(compass.heading_is_true);
  EXPECT_DOUBLE_EQ(*compass.heading_std_rad, 0.03125);
  EXPECT_DOUBLE_EQ(*compass.tilt_std_rad, 0.015625) << "the larger of roll's and pitch's";
  // The magnetic heading of the sensor data is left out while the filter has one.
  const std::vector<mip::Field> sensor{{0x06, wire({0.2F, 0, 0.4F})}, {0x0C, wire({0, 0, -1})}};
  reading.feed(0x80, sensor);
  EXPECT_FALSE(reading.collector.all<CompassSample>().back().heading_rad);
  for (int i = 0; i < 300; ++i) reading.feed(0x80, sensor);
  EXPECT_TRUE(reading.collector.all<CompassSample>().back().heading_rad);
}

TEST(MipSensor, AFilterThatDoesNotKnowNorthGivesTheTiltOnly) {
  MipReading reading;
  reading.feed(0x82, {{0x05, valid(wire({0.125F, -0.25F, 1}))}, {0x0A, valid(wire({0.01F, 0.01F, 3}))}});
  const auto compass = reading.collector.all<CompassSample>().at(0);
  EXPECT_FALSE(compass.heading_rad);
  EXPECT_FALSE(compass.heading_std_rad);
  EXPECT_TRUE(compass.roll_rad);
}

TEST(MipSensor, AFilterThatInitialisesOrIsInvalidGivesNothing) {
  MipReading reading;
  reading.feed(0x82, {{0x05, valid(wire({0, 0, 1}))}, {0x10, {0, 1, 0, 1, 0, 0}}});
  reading.feed(0x82, {{0x05, valid(wire({0, 0, 1}), false)}});
  EXPECT_TRUE(reading.collector.measurements.empty());
}

TEST(MipSensor, IncrementsGiveTheMeanRateAtTheMiddleOfTheirInterval) {
  MipReading reading;
  // D6: 8 ms, that is 7A1200 hexadecimal nanoseconds.
  reading.feed(0x80, {{0xD5, kReference},
                      {0xD6, {0, 0, 0, 0, 0, 0x7A, 0x12, 0}},
                      {0x07, wire({0.008F, 0, -0.004F})},
                      {0x08, wire({0, 0, -0.008F})}});
  ASSERT_EQ(reading.collector.measurements.size(), 1U);
  EXPECT_EQ(reading.collector.measurements[0].device_time_ns, kReference_ns - 4'000'000);
  const auto imu = reading.collector.all<ImuSample>().at(0);
  EXPECT_NEAR((*imu.rate_rad_s)[0], 1, 1e-6);
  EXPECT_NEAR((*imu.rate_rad_s)[2], -0.5, 1e-6);
  EXPECT_NEAR((*imu.specific_force_m_s2)[2], -9.80665, 1e-5);
}

TEST(MipSensor, WithoutComplementaryFilterTheTiltIsTheFilters) {
  MipReading reading;
  reading.feed(0x82, {{0xD5, kReference}, {0x05, valid(wire({0.125F, -0.25F, 1}))}});
  Bytes later = kReference;
  later[5] = static_cast<std::uint8_t>(later[5] + 0x62);  // 98 * 65536 ns = 6.4 ms
  reading.feed(0x80, {{0xD5, later}, {0x06, wire({0.2F, 0, 0.4F})}});
  EXPECT_DOUBLE_EQ(reading.collector.all<CompassSample>().back().roll_rad.value(), 0.125);
  later[4] = static_cast<std::uint8_t>(later[4] + 4);  // 67 ms
  reading.feed(0x80, {{0xD5, later}, {0x06, wire({0.2F, 0, 0.4F})}});
  EXPECT_FALSE(reading.collector.all<CompassSample>().back().roll_rad) << "it is too old";
}

TEST(MipSensor, GpsTimeServesWhereThereIsNoReferenceTime) {
  MipReading reading;
  // 1024.5 s of week 0: 40 90 02 00 ...
  reading.feed(0x80, {{0x12, {0x40, 0x90, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 0}}, {0x05, wire({0, 0, 0})}});
  EXPECT_EQ(reading.collector.measurements.at(0).device_time_ns, 1'024'500'000'000);
}

TEST(MipSensor, WhatCannotBeIsOutOfRange) {
  MipReading reading;
  reading.feed(0x80, {{0x05, wire({0, 100, 0})}});
  reading.feed(0x80, {{0x04, wire({std::numeric_limits<float>::quiet_NaN(), 0, 0})}});
  reading.feed(0x82, {{0x05, valid(wire({0, 0, 7}))}});
  EXPECT_EQ(reading.collector.verdicts, std::vector<Instrument::Verdict>(3, Instrument::Verdict::out_of_range));
  EXPECT_TRUE(reading.collector.measurements.empty());
  reading.feed(0x80, {{0x17, wire({1013.25F})}});
  EXPECT_EQ(reading.collector.verdicts.back(), Instrument::Verdict::ignored) << "the air's pressure is no depth";
}

Bytes mip_capture() { return protocols::test::shared_capture("mip/mip_data_first.bin"); }

TEST(MipSensor, CaptureByOthersGivesPlausibleSamples) {
  const Bytes stream = mip_capture();
  if (stream.empty()) GTEST_SKIP() << "no capture of a MicroStrain sensor here";
  MipReading reading;
  FrameClock clock(125, 0.001);
  reading.collector.feed<mip::Parser>(stream);
  EXPECT_EQ(reading.collector.verdicts.size(), 4543U);
  EXPECT_EQ(std::count(reading.collector.verdicts.begin(), reading.collector.verdicts.end(),
                       Instrument::Verdict::out_of_range),
            0);
  const auto imus = reading.collector.all<ImuSample>();
  EXPECT_EQ(imus.size(), 1943U + 485U);
  // At the beginning the sensor lies still and nearly level: the force opposes gravity.
  EXPECT_NEAR((*imus[0].specific_force_m_s2)[2], -9.67, 0.05);
  EXPECT_EQ(reading.collector.all<CompassSample>().size(), 972U + 485U + 485U + 387U);
  int true_headings = 0;
  for (const auto& measurement : reading.collector.measurements) {
    if (const auto* compass = std::get_if<CompassSample>(&measurement.value))
      true_headings += compass->heading_is_true ? 1 : 0;
    if (!measurement.device_time_ns) continue;
    // Arrivals 3 ms after the device's own times: its clock and ours agree.
    const auto outcome = clock.update(
        {*measurement.device_time_ns + 3'000'000, {}, false, measurement.device_time_ns, measurement.paces});
    EXPECT_LE(outcome.time.time_ns, *measurement.device_time_ns + 3'000'000);
  }
  EXPECT_EQ(true_headings, 387);
}

TEST(MipSensor, TheCaptureCutAndDamagedAnywhereDoesNoHarm) {
  const Bytes stream = mip_capture();
  if (stream.empty()) GTEST_SKIP() << "no capture of a MicroStrain sensor here";
  const Bytes part(stream.begin(), stream.begin() + 600);
  MipReading whole;
  whole.collector.feed<mip::Parser>(part);
  for (std::size_t cut = 0; cut < part.size(); ++cut) {
    MipReading reading;
    reading.collector.feed<mip::Parser>(protocols::Bytes(part).first(cut));
    EXPECT_LE(reading.collector.measurements.size(), whole.collector.measurements.size());
    for (int bit = 0; bit < 8; ++bit) {
      Bytes damaged = part;
      damaged[cut] = static_cast<std::uint8_t>(damaged[cut] ^ 1U << bit);
      MipReading other;
      other.collector.feed<mip::Parser>(damaged);
      EXPECT_LE(other.collector.measurements.size(), whole.collector.measurements.size());
    }
  }
}

}  // namespace
}  // namespace navcal::instruments
