// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "protocols/ubx.h"
#include "tests/protocols/shared_capture.h"
#include "tests/protocols/text.h"
#include "tests/protocols/ubx_samples.h"

namespace navcal::protocols::test {
namespace {

TEST(UbxStream, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<ubx::PortScanner>(mixture(random, random_ubx_port_frame, 40)));
    EXPECT_TRUE(same_however_cut<ubx::Scanner>(mixture(random, random_ubx_frame, 40)));
  }
}

TEST(UbxStream, EveryCutAndEveryFlippedBit) {
  Random random(2);
  const Buffer frame = ubx::encode_nav_pvt(random_pvt(random));
  Buffer stream = frame;
  append(stream, bytes_of(line("GPGGA,,,,,,0,,,,,,,,")));
  append(stream, frame);
  EXPECT_TRUE(every_cut_gives_a_prefix<ubx::PortScanner>(stream));
  EXPECT_TRUE(every_flipped_bit_shows<ubx::PortScanner>(frame));
  EXPECT_TRUE(every_flipped_bit_shows<ubx::PortScanner>(encode_rtcm3(Buffer(40, 0x5A))));
}

TEST(UbxStream, KindsAreTold) {
  Buffer stream = ubx::encode_frame(0x1234, Buffer{1, 2, 3});
  append(stream, bytes_of(line("GNRMC,,V,,,,,,,,,,N")));
  append(stream, encode_rtcm3(Buffer{0x3E, 0xD0, 0, 3}));
  std::string kinds;
  ubx::PortParser parser;
  parser.feed(stream, [&](const Frame& frame) {
    kinds += std::to_string(static_cast<int>(ubx::kind_of(frame))) + std::string(frame.id.view()) + ' ';
    EXPECT_EQ(ubx::code_of(frame).has_value(), ubx::kind_of(frame) == ubx::Kind::ubx);
  });
  EXPECT_EQ(kinds, "01234 1GNRMC 2RTCM3 ");
  EXPECT_EQ(parser.counters().skipped_bytes, 0U);
}

TEST(UbxStream, FramesHaveTheNamesOfTheProtocol) {
  const std::pair<ubx::MessageCode, const char*> named[] = {
      {0x0104, "NAV-DOP"},  {0x0107, "NAV-PVT"},    {0x0120, "NAV-TIMEGPS"}, {0x0135, "NAV-SAT"},
      {0x0501, "ACK-ACK"},  {0x068A, "CFG-VALSET"}, {0x0A04, "MON-VER"},     {0x0164, "NAV-TIMETRUSTED"},
      {0x1002, "ESF-MEAS"}, {0x0215, "RXM-RAWX"},   {0x2907, "NAV2-PVT"},    {0x2703, "SEC-UNIQID"},
      {0x0199, "0199"},     {0xABCD, "ABCD"},       {0x0000, "0000"}};
  for (const auto& [code, name] : named) EXPECT_EQ(ubx::id_of(code).view(), name);
  // No two messages share a name, and none is cut.
  std::set<std::string_view> names;
  for (unsigned code = 0; code < 0x10000; ++code) {
    const std::string_view name = ubx::name_of(static_cast<ubx::MessageCode>(code));
    if (name.empty()) continue;
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_EQ(ubx::id_of(static_cast<ubx::MessageCode>(code)).view(), name);
  }
  EXPECT_GT(names.size(), 150U);
}

TEST(UbxStream, KnownChecksums) {
  // Poll of MON-VER as the interface description's checksum rule gives it by hand: 0A 04 00 00.
  EXPECT_EQ(ubx::encode_frame(0x0A04, {}), (Buffer{0xB5, 0x62, 0x0A, 0x04, 0, 0, 0x0E, 0x34}));
  // The empty message of RTCM3, whose CRC-24Q is published.
  EXPECT_EQ(encode_rtcm3({}), (Buffer{0xD3, 0, 0, 0x47, 0xEA, 0x4B}));
}

TEST(UbxStream, ATooLongMessageDoesNotHoldTheParser) {
  Buffer stream{0xB5, 0x62, 1, 7, 0xFF, 0xFF};
  const Buffer frame = ubx::encode_frame(0x0107, Buffer(92));
  append(stream, frame);
  const Outcome seen = all_at_once<ubx::Scanner>(stream);
  EXPECT_EQ(seen.frames.size(), 1U);
  EXPECT_EQ(seen.skipped_bytes, 6U);
}

TEST(UbxStream, CountsOfCapturesByOthers) {
  const std::pair<const char*, std::size_t> files[] = {
      {"MIXED", 300}, {"MIXED2", 26}, {"MIXED3BADCK", 1}, {"BADCK2", 25}, {"BADEOF1", 3},          {"BADEOF2", 2},
      {"BADEOF3", 2}, {"BADHDR", 2},  {"NAV", 28},        {"MON", 12},    {"SF-calibration", 1621}};
  for (const auto& [name, count] : files) {
    const Buffer stream = shared_capture(std::string("ubx/pygpsdata-") + name + ".log");
    if (stream.empty()) GTEST_SKIP() << "no captures of u-blox receivers here";
    std::size_t ubx_frames = 0;
    for (const Seen& seen : all_at_once<ubx::PortScanner>(stream).frames) ubx_frames += seen.bytes[0] == 0xB5;
    EXPECT_EQ(ubx_frames, count) << name;
    EXPECT_EQ(all_at_once<ubx::Scanner>(stream).frames.size(), count) << name;
    EXPECT_TRUE(same_however_cut<ubx::PortScanner>(stream)) << name;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
