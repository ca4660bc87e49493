// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "protocols/crc16.h"
#include "protocols/vectornav_lines.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/text.h"
#include "tests/protocols/vectornav_samples.h"

namespace navcal::protocols::test {
namespace {

TEST(VectorNav, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const vectornav::Reading reading = random_vectornav_reading(random);
    EXPECT_EQ(vectornav::decode_binary(vectornav::encode_binary(reading)), reading);
  }
}

TEST(VectorNav, TheLine) {
  const auto reading =
      vectornav::decode_line(bytes_of(line("VNYMR,+100.949,-002.160,+000.310,-00.0478,+01.0670,+01.7383,-00.363,-"
                                           "00.165,-09.725,+00.001,-00.002,-00.003")));
  ASSERT_TRUE(reading);
  EXPECT_NEAR((*reading->yaw_pitch_roll_deg)[0], 100.949, 1e-9);
  EXPECT_NEAR((*reading->field_uT)[1], 106.7, 1e-9);
  EXPECT_NEAR((*reading->acceleration_m_s2)[2], -9.725, 1e-9);
  EXPECT_NEAR((*reading->rate_rad_s)[1], -0.002, 1e-9);
  EXPECT_FALSE(vectornav::decode_line(bytes_of(line("VNYMR,1,2,3"))));
  EXPECT_FALSE(vectornav::decode_line(bytes_of(line("VNYXR,1,2,3"))));
  const auto again = vectornav::decode_line(vectornav::encode_line(*reading));
  ASSERT_TRUE(again);
  EXPECT_NEAR((*again->field_uT)[0], -4.78, 1e-9);
}

/// A message with the groups and fields of these words and `payload` bytes.
Buffer message(const Buffer& head, std::size_t payload) {
  Buffer frame = head;
  frame.resize(frame.size() + payload, 0x55);
  const std::uint16_t crc = crc16_xmodem(Bytes(frame).subspan(1));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
  frame.push_back(static_cast<std::uint8_t>(crc));
  return frame;
}

TEST(VectorNav, OtherGroupsAreCounted) {
  // IMU: three uncompensated vectors, temperature, pressure; attitude: angles, matrix, two vectors.
  const Buffer frame = message({0xFA, 0x14, 0x3E, 0x00, 0x3A, 0x00}, 44 + 72);
  EXPECT_EQ(all_at_once<vectornav::Scanner>(frame).frames.size(), 1U);
  const auto reading = vectornav::decode_binary(frame);
  EXPECT_EQ(reading->unknown_fields, 3U) << "the matrix, two vectors";
  EXPECT_TRUE(reading->raw_field_uT && reading->raw_acceleration_m_s2 && reading->raw_rate_rad_s);
  EXPECT_TRUE(reading->temperature_C && reading->pressure_Pa && reading->yaw_pitch_roll_deg);
  // A list of satellites has no fixed size.
  EXPECT_TRUE(all_at_once<vectornav::Scanner>(message({0xFA, 0x08, 0x00, 0x40}, 20)).frames.empty());
}

/// Appends numbers as they lie in the machine, which is little endian as the wire.
template <class T>
void put(Buffer& buffer, std::initializer_list<T> values) {
  for (const T value : values) {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    append(buffer, Buffer(bytes.begin(), bytes.end()));
  }
}

TEST(VectorNav, TheSameQuantitiesOfTheGroupsTimeImuAndAttitude) {
  // Time: since start-up. IMU: temperature, pressure, field, acceleration, rate. Attitude: angles, their errors.
  Buffer body{0xFA, 0x16, 0x01, 0x00, 0x30, 0x07, 0x02, 0x01};
  put<std::uint64_t>(body, {123'456'789'012});
  put<float>(body, {21.5F, 101.25F, 0.25F, -0.5F, 0.75F, 1, 2, -9.75F, 0.125F, 0.25F, 0.5F});
  put<float>(body, {90, 10, -5, 2, 0.5F, 0.25F});
  const Buffer frame = message(body, 0);
  ASSERT_EQ(all_at_once<vectornav::Scanner>(frame).frames.size(), 1U);
  vectornav::Reading expected;
  expected.since_startup_ns = 123'456'789'012;
  expected.temperature_C = 21.5;
  expected.pressure_Pa = 101'250;
  expected.field_uT = {25, -50, 75};
  expected.acceleration_m_s2 = {1, 2, -9.75};
  expected.rate_rad_s = {0.125, 0.25, 0.5};
  expected.yaw_pitch_roll_deg = {90, 10, -5};
  expected.yaw_pitch_roll_std_deg = {2, 0.5, 0.25};
  EXPECT_EQ(vectornav::decode_binary(frame), expected);
}

TEST(VectorNav, OtherLines) {
  const auto read = [](const char* body) { return vectornav::decode_line(bytes_of(line(body))); };
  EXPECT_EQ(read("VNYPR,+010.071,+000.278,-002.026")->yaw_pitch_roll_deg,
            (vectornav::Triple{10.071, 0.278, -2.026}));
  const auto imu = read(
      "VNIMU,-02.0841,+00.6045,+02.8911,-00.381,-00.154,-09.657,-00.005683,+00.000262,+00.001475,"
      "+21.6,+00099.761");
  ASSERT_TRUE(imu);
  EXPECT_NEAR((*imu->raw_field_uT)[0], -208.41, 1e-9);
  EXPECT_NEAR((*imu->raw_acceleration_m_s2)[2], -9.657, 1e-9);
  EXPECT_NEAR((*imu->raw_rate_rad_s)[2], 0.001475, 1e-12);
  EXPECT_NEAR(*imu->pressure_Pa, 99'761, 1e-6);
  EXPECT_NEAR((*read("VNMAR,1,2,3,4,5,6,7,8,9")->rate_rad_s)[2], 9, 1e-12);
  EXPECT_NEAR((*read("VNMAG,0.1,0.2,0.3")->field_uT)[2], 30, 1e-12);
  EXPECT_NEAR((*read("VNACC,1,2,3")->acceleration_m_s2)[2], 3, 1e-12);
  EXPECT_NEAR((*read("VNGYR,1,2,3")->rate_rad_s)[0], 1, 1e-12);
  for (const char* body : {"VNYPR,1,2", "VNYPR,1,2,x", "VNIMU,1", "VNWRG,06,0", "VNQTN,1,2,3,4", "VNYPR"})
    EXPECT_FALSE(read(body)) << body;
}

TEST(VectorNav, RegistersAndErrors) {
  const vectornav::Register output{true, vectornav::kBinaryOutput1, "1,20,11,0529,0100"};
  const Buffer written = vectornav::encode_register(output);
  EXPECT_EQ(std::string(written.begin(), written.begin() + 27), "$VNWRG,75,1,20,11,0529,0100");
  EXPECT_EQ(vectornav::decode_register(written), output);
  const Buffer question = vectornav::encode_register({false, vectornav::kModel, ""});
  EXPECT_EQ(std::string(question.begin(), question.end()), "$VNRRG,01*72\r\n") << "as the manual's example has it";
  EXPECT_EQ(vectornav::decode_register(bytes_of(line("VNRRG,01,VN-100T-CR")))->values, "VN-100T-CR");
  EXPECT_FALSE(vectornav::decode_register(bytes_of(line("VNRRG,x"))));
  EXPECT_FALSE(vectornav::decode_register(bytes_of(line("VNERR,03"))));
  const Buffer error = vectornav::encode_error(12);
  EXPECT_EQ(std::string(error.begin(), error.begin() + 9), "$VNERR,0C");
  EXPECT_EQ(vectornav::decode_error(error), 12);
  EXPECT_FALSE(vectornav::decode_error(bytes_of(line("VNERR,"))));
  EXPECT_EQ(vectornav::meaning_of(3), "invalid checksum");
  EXPECT_EQ(vectornav::meaning_of(0x0C), vectornav::meaning_of(0x12));
  EXPECT_EQ(vectornav::meaning_of(0x0C), "insufficient baud rate");
  EXPECT_EQ(vectornav::meaning_of(0x40), "unknown");
}

TEST(VectorNav, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<vectornav::Scanner>(mixture(random, random_frame<vectornav::Scanner>, 60)));
  }
  Random random(4);
  Buffer stream = vectornav::encode_binary(random_vectornav_reading(random));
  append(stream, vectornav::encode_line(random_vectornav_reading(random)));
  EXPECT_TRUE(every_cut_gives_a_prefix<vectornav::Scanner>(stream));
  EXPECT_TRUE(
      every_flipped_bit_shows<vectornav::Scanner>(vectornav::encode_binary(random_vectornav_reading(random))));
}

// Bytes of each field as the manual lists them; behind the last one of a group are reserved bits.
TEST(VectorNav, EveryFieldHasItsSizeAndReservedBitsAreNoMessage) {
  const std::vector<std::vector<std::size_t>> sizes{{8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8},
                                                    {8, 8, 8, 2, 8, 8, 8, 4, 4, 1},
                                                    {2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2},
                                                    {8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28},
                                                    {2, 12, 16, 36, 12, 12, 12, 12, 12},
                                                    {2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4},
                                                    {8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28}};
  for (std::size_t group = 0; group < sizes.size(); ++group) {
    for (unsigned bit = 0; bit < 16; ++bit) {
      const unsigned word = 1U << bit;
      const Buffer head{0xFA, static_cast<std::uint8_t>(1U << group), static_cast<std::uint8_t>(word),
                        static_cast<std::uint8_t>(word >> 8)};
      const bool is_known = bit < sizes[group].size();
      const Buffer frame = message(head, is_known ? sizes[group][bit] : 1);
      EXPECT_EQ(all_at_once<vectornav::Scanner>(frame).frames.size(), is_known ? 1U : 0U) << group << ' ' << bit;
    }
  }
}

TEST(VectorNav, ALineHasTheFieldsOfItsNameAlone) {
  vectornav::Reading reading;
  reading.yaw_pitch_roll_deg = {100.5, -2.25, 0.5};
  reading.field_uT = {-5, 107, 174};
  reading.acceleration_m_s2 = {-0.25, -0.5, -9.75};
  reading.rate_rad_s = {0.125, -0.25, 0.5};
  const auto again = vectornav::decode_line(vectornav::encode_line(reading));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->yaw_pitch_roll_deg, reading.yaw_pitch_roll_deg);
  EXPECT_EQ(again->acceleration_m_s2, reading.acceleration_m_s2);
  EXPECT_EQ(again->rate_rad_s, reading.rate_rad_s);
}

}  // namespace
}  // namespace navcal::protocols::test
