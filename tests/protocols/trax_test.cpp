// SPDX-License-Identifier: Apache-2.0
#include "protocols/trax.h"

#include <gtest/gtest.h>

#include "protocols/crc16.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/text.h"
#include "tests/protocols/trax_samples.h"

namespace navcal::protocols::test {
namespace {

TEST(Trax, ChecksumOfTheCatalogue) { EXPECT_EQ(crc16_xmodem(bytes_of("123456789")), 0x31C3); }

TEST(Trax, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const trax::Data data = random_trax_data(random);
    EXPECT_EQ(trax::decode_data(trax::encode_data(data)), data);
  }
  EXPECT_EQ(trax::decode_sample_count(trax::encode_sample_count(12)), 12U);
  const trax::Score score{0.5, 0, 1.25, 2, 0.75, 40};
  EXPECT_EQ(trax::decode_score(trax::encode_score(score)), score);
}

TEST(Trax, CommandsByteForByte) {
  // kGetModInfo: 00 05 01 and the checksum EF D4.
  EXPECT_EQ(trax::encode_frame(trax::FrameNumber::get_module_info), (Buffer{0x00, 0x05, 0x01, 0xEF, 0xD4}));
  const trax::Component components[] = {trax::Component::heading, trax::Component::pitch};
  const Buffer wanted = trax::encode_components(components);
  EXPECT_EQ(Buffer(wanted.begin(), wanted.end() - 2), (Buffer{0, 8, 3, 2, 5, 24}));
  const Buffer points = trax::encode_setting(trax::Setting::calibration_points, 12);
  EXPECT_EQ(Buffer(points.begin(), points.end() - 2), (Buffer{0, 10, 6, 12, 0, 0, 0, 12}));
  const Buffer north = trax::encode_setting(trax::Setting::true_north, 1);
  EXPECT_EQ(Buffer(north.begin(), north.end() - 2), (Buffer{0, 7, 6, 2, 1}));
}

TEST(Trax, AcquisitionByteForByte) {
  // Continuous, no flush, reserved, 0.5 s as a float: 3F 00 00 00.
  const Buffer frame = trax::encode_acquisition({false, 0.5});
  EXPECT_EQ(Buffer(frame.begin(), frame.end() - 2), (Buffer{0, 15, 24, 0, 0, 0, 0, 0, 0, 0x3F, 0, 0, 0}));
  EXPECT_EQ(trax::decode_acquisition(frame), (trax::Acquisition{false, 0.5}));
  EXPECT_EQ(trax::decode_acquisition(trax::encode_acquisition({true, 0})), (trax::Acquisition{true, 0}));
}

TEST(Trax, NamesOfTheManual) {
  EXPECT_EQ(trax::id_of(5).view(), "DataResp");
  EXPECT_EQ(trax::id_of(17).view(), "UserCalSampCount");
  EXPECT_EQ(trax::id_of(31).view(), "TakeUserCalSampl") << "sixteen letters";
  EXPECT_EQ(trax::id_of(0).view(), "00");
  EXPECT_EQ(trax::id_of(200).view(), "C8");
}

TEST(Trax, SaveDoneSaysWhetherItWasSaved) {
  EXPECT_EQ(trax::decode_save_done(trax::encode_frame(trax::FrameNumber::save_done, Buffer{0, 0})), true);
  EXPECT_EQ(trax::decode_save_done(trax::encode_frame(trax::FrameNumber::save_done, Buffer{0, 1})), false);
  EXPECT_FALSE(trax::decode_save_done(trax::encode_frame(trax::FrameNumber::save_done, Buffer{0})));
}

TEST(Trax, AnUnknownComponentEndsTheReading) {
  const Buffer payload{3, 8, 1, 200, 5, 0, 0, 0, 0};
  const auto data = trax::decode_data(trax::encode_frame(trax::FrameNumber::data, payload));
  ASSERT_TRUE(data);
  EXPECT_EQ(data->distorted, true);
  EXPECT_EQ(data->unread, 2U);
  EXPECT_FALSE(trax::decode_data(trax::encode_frame(trax::FrameNumber::data, Buffer{1, 5, 0, 0})));
  EXPECT_FALSE(trax::decode_data(trax::encode_frame(trax::FrameNumber::data, Buffer{1})));
}

TEST(Trax, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<trax::Scanner>(mixture(random, random_frame<trax::Scanner>, 60)));
  }
  Random random(4);
  Buffer stream = trax::encode_data(random_trax_data(random));
  append(stream, trax::encode_data(random_trax_data(random)));
  EXPECT_TRUE(every_cut_gives_a_prefix<trax::Scanner>(stream));
  EXPECT_TRUE(every_flipped_bit_shows<trax::Scanner>(trax::encode_data(random_trax_data(random))));
}

}  // namespace
}  // namespace navcal::protocols::test
