// SPDX-License-Identifier: Apache-2.0
#include "protocols/vectornav.h"

#include <gtest/gtest.h>

#include "protocols/crc16.h"
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
  EXPECT_FALSE(vectornav::decode_line(bytes_of(line("VNYPR,1,2,3"))));
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
  EXPECT_EQ(vectornav::decode_binary(frame)->unknown_fields, 9U);
  // A list of satellites has no fixed size.
  EXPECT_TRUE(all_at_once<vectornav::Scanner>(message({0xFA, 0x08, 0x00, 0x40}, 20)).frames.empty());
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

}  // namespace
}  // namespace navcal::protocols::test
