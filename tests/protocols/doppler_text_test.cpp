// SPDX-License-Identifier: Apache-2.0
// Doppler logs that send text: Teledyne PD6 and Water Linked.
#include <gtest/gtest.h>

#include <string>

#include "protocols/crc16.h"
#include "protocols/text_fields.h"
#include "tests/protocols/doppler_text_samples.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::test {
namespace {

struct PrintedContent {
  double depth_m = 0;
  std::optional<std::uint8_t> beams;
  std::array<double, 2> tilt_deg{};
  bool valid = false;
  bool operator==(const PrintedContent&) const = default;
};

TEST(TextFields, WhatIsWrittenIsReadByTheSameFunction) {
  using Content = PrintedContent;
  constexpr auto kLayOut = [](auto& line, auto& content) {
    line.number(content.depth_m, Print{1, 4, true});
    line.number(content.beams);
    line.number(content.tilt_deg, Print{2});
    line.letter(content.valid, 'y', 'n');
  };
  const Content content{-12.5, {}, {0.25, -3}, true};
  EXPECT_EQ(line_of("X", content, kLayOut), "X,-0012.5,,0.25,-3.00,y");
  EXPECT_EQ(content_of<Content>(LineReader("-0012.5,,0.25,-3.00,y"), kLayOut), content);
  EXPECT_EQ(content_of<Content>(LineReader("+1,4,0,0,n"), kLayOut), (Content{1, std::uint8_t{4}, {}, false}));
  // A field too many or too few, a letter that is neither, what is no number, and one that does not fit.
  for (const char* wrong : {"1,4,0,0,n,", "1,4,0,0", "1,4,0,0,N", ",4,0,0,n", "1,256,0,0,n", "1,4,0,0,n,5"})
    EXPECT_FALSE(content_of<Content>(LineReader(wrong), kLayOut)) << wrong;
  EXPECT_FALSE(content_of<Content>(LineReader("+1,4,0,0,n", decimal), kLayOut)) << "a plain decimal has no plus";
}

TEST(Pd6, LinesOfEachKind) {
  const auto attitude = pd6::decode_attitude(bytes_of(":SA, -2.31, +4.92,359.58\r\n"));
  EXPECT_EQ(attitude, (pd6::Attitude{-2.31, 4.92, 359.58}));
  const auto velocity = pd6::decode_velocity(bytes_of(":BI,+00000,-02345,-00439,+00012,A\r\n"));
  ASSERT_TRUE(velocity);
  EXPECT_NEAR(*velocity->velocity_m_s[1], -2.345, 1e-12);
  EXPECT_NEAR(*velocity->error_velocity_m_s, 0.012, 1e-12);
  EXPECT_TRUE(velocity->good);
  const auto lost = pd6::decode_velocity(bytes_of(":BE,-32768,-32768,-32768,V\r\n"));
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->good);
  EXPECT_FALSE(lost->velocity_m_s[0]);
  const auto distance =
      pd6::decode_distance(bytes_of(":BD,+00000000.00,-00000001.50,+00000000.00,0020.40,000.25\r\n"));
  ASSERT_TRUE(distance);
  EXPECT_EQ(distance->east_north_up_m[1], -1.5);
  EXPECT_EQ(distance->range_m, 20.4);
  EXPECT_EQ(distance->since_good_s, 0.25);
  const auto timing = pd6::decode_timing(bytes_of(":TS,16081317340100,35.0,+15.0,0002.5,1500.1,000\r\n"));
  ASSERT_TRUE(timing);
  EXPECT_EQ(timing->speed_of_sound_m_s, 1500.1);
}

TEST(Pd6, WhatIsEncodedIsDecoded) {
  EXPECT_EQ(text_of(pd6::encode(pd6::Attitude{-2.31, 4.92, 359.58})), ":SA,-02.31,+04.92,359.58\r\n");
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const pd6::Velocity velocity = random_pd6_velocity(random);
    const auto again = pd6::decode_velocity(pd6::encode(velocity));
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, velocity);
  }
  const pd6::Distance distance{pd6::kWaterDistance, {1.25, -3.5, 0}, 12.5, 0.75};
  EXPECT_EQ(pd6::decode_distance(pd6::encode(distance)), distance);
  pd6::Timing timing;
  timing.clock.fill('1');
  timing.temperature_C = -1.5;
  EXPECT_EQ(pd6::decode_timing(pd6::encode(timing)), timing);
}

TEST(Pd6, LinesThatCannotBe) {
  for (const std::string_view text :
       {":BI,1,2,3,A\r\n", ":BI,1,2,3,x,A\r\n", ":BE,1,2,3,4,A\r\n", ":BE,,2,3,A\r\n"}) {
    EXPECT_FALSE(pd6::decode_velocity(bytes_of(text))) << text;
  }
  for (const std::string_view fields : {"x,15.0,2.5,1500.1,000", "35.0,x,2.5,1500.1,000", "35.0,15.0,x,1500.1,000",
                                        "35.0,15.0,2.5,x,000", "35.0,15.0,2.5,1500.1,0x", "35.0,15.0,2.5,1500.1"})
    EXPECT_FALSE(pd6::decode_timing(bytes_of(":TS,16081317340100," + std::string(fields) + "\r\n"))) << fields;
  EXPECT_FALSE(pd6::decode_timing(bytes_of(":TS,160813,35.0,15.0,2.5,1500.1,000\r\n"))) << "half a clock";
  const Outcome seen =
      all_at_once<pd6::Scanner>(bytes_of(":XX,1\r\n:BI;1\r\n:BI,\x01\r\n:SA,1,2,3\r\r:SA,1,2,3\n"));
  EXPECT_EQ(seen.frames.size(), 1U);
}

TEST(WaterLinked, LinesOfTheDocumentation) {
  for (const std::string_view text :
       {"wrz,0.120,-0.400,2.000,y,1.30,1.855,1e-07;0;1.4;0;1.2;0;0.2;0;1e+09,7,14,123.00,1*50\n",
        "wru,0,0.070,1.10,-40,-95*9c\n", "wru,1,-0.500,1.25,-62,-104*f0\n", "wrc,1480,20,n,y*59\n",
        "wrp,49056.809,0.41,0.15,1.23,0.4,53.9,13.0,19.3,0*de\n",
        "wrx,112.83,0.007,0.017,0.006,0.000,0.93,y,0*d2\r\n",
        "wrx,1075.51,0.000,0.000,0.000,2.707,-1.00,n,1*04\n"}) {
    EXPECT_EQ(all_at_once<water_linked::Scanner>(bytes_of(text)).frames.size(), 1U) << text;
  }
  EXPECT_EQ(crc8(bytes_of("123456789")), 0xF4);
  const auto velocity = water_linked::decode_velocity(
      bytes_of("wrz,0.120,-0.400,2.000,y,1.30,1.855,1e-07;0;1.4;0;1.2;0;0.2;0;1e+09,7,14,123.00,1*50\n"));
  ASSERT_TRUE(velocity);
  EXPECT_EQ(velocity->velocity_m_s, (std::array{0.12, -0.4, 2.0}));
  EXPECT_EQ((*velocity->covariance_m2_s2)[8], 1e9);
  EXPECT_EQ(velocity->valid_at_us, 7);
  EXPECT_EQ(velocity->altitude_m, 1.3);
  EXPECT_EQ(velocity->status, 1U);
  const auto old = water_linked::decode_velocity(bytes_of("wrx,1075.51,0.000,0.000,0.000,2.707,-1.00,n,1*04\n"));
  ASSERT_TRUE(old);
  EXPECT_FALSE(old->valid);
  EXPECT_EQ(old->altitude_m, -1);
}

TEST(WaterLinked, ObjectsOfTheNetworkPort) {
  for (const bool with_blanks : {false, true}) {
    const std::string line = water_linked_json(with_blanks);
    const auto seen = all_at_once<water_linked::Scanner>(bytes_of(line));
    ASSERT_EQ(seen.frames.size(), 1U);
    EXPECT_EQ(seen.frames[0].id, water_linked::kVelocityJson);
    const auto velocity = water_linked::decode_velocity(bytes_of(line));
    ASSERT_TRUE(velocity);
    EXPECT_EQ(velocity->velocity_m_s, (std::array{0.123, -0.045, 0.010}));
    EXPECT_TRUE(velocity->valid);
    EXPECT_EQ(velocity->altitude_m, 3.21);
    EXPECT_EQ(velocity->figure_of_merit_m_s, 0.0012);
    EXPECT_EQ(velocity->since_last_ms, 125.1);
    EXPECT_EQ(velocity->covariance_m2_s2, (std::array{4e-6, 0.0, -1e-7, 0.0, 1.1e-6, 0.0, 0.0, 0.0, 1e-6}));
    EXPECT_EQ(velocity->valid_at_us, 1'790'000'000'000'000);
    EXPECT_EQ(velocity->transmitted_at_us, 1'790'000'000'120'000);
    std::string damaged = line;
    damaged.replace(damaged.find("-0.045"), 6, "\"none\"");
    EXPECT_FALSE(water_linked::decode_velocity(bytes_of(damaged)));
  }
  const std::string position =
      R"({"ts":49056.809,"x":0.41,"y":0.15,"z":1.23,"std":0.4,"roll":53.9,"pitch":13.0,"yaw":19.3,)"
      R"("type":"position_local","status":0,"format":"json_v3.1"})"
      "\r\n";
  EXPECT_EQ(water_linked::decode_position(bytes_of(position)),
            (water_linked::Position{49056.809, {0.41, 0.15, 1.23}, 0.4, 53.9, 13.0, 19.3, 0}));
  const std::string answer = R"({"response_to":"get_config","success":true,"result":{"a":[]},"type":"response"})"
                             "\n";
  // Lines that were cut, in the middle and in a text, cost themselves alone.
  const std::string velocity = water_linked_json(false);
  const auto seen = all_at_once<water_linked::Scanner>(
      bytes_of(velocity.substr(0, 300) + position + velocity.substr(0, 12) + "\n" + answer + position));
  ASSERT_EQ(seen.frames.size(), 3U);
  EXPECT_EQ(seen.frames[0].id, water_linked::kPositionJson);
  EXPECT_EQ(seen.frames[1].id.view(), "response");
}

TEST(WaterLinked, WhatIsEncodedIsDecoded) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const water_linked::Velocity velocity = random_water_linked_velocity(random);
    EXPECT_EQ(water_linked::decode_velocity(water_linked::encode(velocity)), velocity);
  }
  const water_linked::Transducer beam{2, -0.5, 1.25, -62, -104};
  EXPECT_EQ(water_linked::decode_transducer(water_linked::encode(beam)), beam);
  EXPECT_EQ(water_linked::decode_position(
                water_linked::encode_line("wrp,49056.809,0.41,0.15,1.23,0.4,53.9,13.0,19.3,0")),
            (water_linked::Position{49056.809, {0.41, 0.15, 1.23}, 0.4, 53.9, 13.0, 19.3, 0}));
}

TEST(DopplerText, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<pd6::Scanner>(mixture(random, random_frame<pd6::Scanner>, 60)));
    EXPECT_TRUE(same_however_cut<water_linked::Scanner>(mixture(random, random_frame<water_linked::Scanner>, 60)));
  }
}

TEST(DopplerText, EveryCutAndEveryFlippedBit) {
  Random random(4);
  Buffer stream = random_frame<pd6::Scanner>(random);
  append(stream, random_frame<pd6::Scanner>(random));
  EXPECT_TRUE(every_cut_gives_a_prefix<pd6::Scanner>(stream));
  const Buffer frame = water_linked::encode(random_water_linked_velocity(random));
  EXPECT_TRUE(every_cut_gives_a_prefix<water_linked::Scanner>(frame));
  // The end of the line and the case of the checksum carry no bits that the CRC guards.
  const Buffer guarded(frame.begin(), frame.end() - 4);
  for (std::size_t bit = 0; bit < 8 * (guarded.size() - 1); ++bit) {
    Buffer damaged = frame;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    for (const Seen& seen : all_at_once<water_linked::Scanner>(damaged).frames) EXPECT_NE(seen.offset, 0U) << bit;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
