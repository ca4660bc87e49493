// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <numbers>

#include "protocols/trax.h"
#include "tests/instruments/collector.h"

namespace navcal::instruments {
namespace {

namespace trax = protocols::trax;

/// kDataResp: component numbers and their values, floats most significant byte first.
std::vector<std::uint8_t> data_frame(std::initializer_list<std::pair<int, float>> floats) {
  std::vector<std::uint8_t> payload{static_cast<std::uint8_t>(floats.size())};
  for (const auto& [component, value] : floats) {
    payload.push_back(static_cast<std::uint8_t>(component));
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 24; shift >= 0; shift -= 8) payload.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  return trax::encode_frame(trax::FrameNumber::data, payload);
}

struct PniReading {
  Collector collector{protocols::Protocol::pni};
  void feed(const std::vector<std::uint8_t>& frame) { collector.feed<trax::Parser>(frame); }
};

TEST(PniCompass, DataInUnitsOfTheSystem) {
  PniReading reading;
  reading.feed(data_frame({{5, 270}, {24, -90}, {25, 45}, {27, 18.5F}, {28, -2.25F}, {29, 43}, {7, 21.5F}}));
  ASSERT_EQ(reading.collector.measurements.size(), 1U);
  EXPECT_TRUE(reading.collector.measurements[0].paces);
  const auto sample = reading.collector.all<CompassSample>().at(0);
  EXPECT_DOUBLE_EQ(*sample.heading_rad, 1.5 * std::numbers::pi);
  EXPECT_FALSE(sample.heading_is_true);
  EXPECT_DOUBLE_EQ(*sample.pitch_rad, -std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(*sample.roll_rad, std::numbers::pi / 4);
  EXPECT_EQ(sample.field_body_uT, (Vector3{18.5, -2.25, 43}));
  EXPECT_EQ(sample.temperature_C, 21.5);
  EXPECT_FALSE(sample.error);
}

TEST(PniCompass, TheForceOpposesGravityWhateverTheDevicesSign) {
  for (const float sign : {1.0F, -1.0F}) {
    PniReading reading;
    reading.feed(data_frame({{24, 0}, {25, 0}, {21, 0.125F * sign}, {22, 0}, {23, sign}}));
    const auto imu = reading.collector.all<ImuSample>().at(0);
    EXPECT_NEAR((*imu.specific_force_m_s2)[2], -9.80665, 1e-5);
    EXPECT_NEAR((*imu.specific_force_m_s2)[0], -0.125 * 9.80665, 1e-5);
    EXPECT_FALSE(reading.collector.measurements.back().paces);
  }
  PniReading without_tilt;
  without_tilt.feed(data_frame({{5, 10}, {21, 0}, {22, 0}, {23, 1}}));
  EXPECT_TRUE(without_tilt.collector.all<ImuSample>().empty());
}

TEST(PniCompass, DistortionIsARemark) {
  PniReading reading;
  std::vector<std::uint8_t> payload{2, 8, 1, 5, 0x42, 0x20, 0, 0};  // distortion, 40 degrees
  reading.feed(trax::encode_frame(trax::FrameNumber::data, payload));
  const auto sample = reading.collector.all<CompassSample>().at(0);
  EXPECT_EQ(sample.error, 1U);
  EXPECT_NEAR(*sample.heading_rad, 40 * std::numbers::pi / 180, 1e-12);
}

TEST(PniCompass, WhatCannotBeIsOutOfRange) {
  PniReading reading;
  reading.feed(data_frame({{5, 361}}));
  reading.feed(data_frame({{24, 91}}));
  reading.feed(data_frame({{27, std::numeric_limits<float>::quiet_NaN()}}));
  EXPECT_EQ(reading.collector.verdicts, std::vector<Instrument::Verdict>(3, Instrument::Verdict::out_of_range));
  reading.feed(trax::encode_sample_count(3));
  EXPECT_EQ(reading.collector.verdicts.back(), Instrument::Verdict::ignored);
}

}  // namespace
}  // namespace navcal::instruments
