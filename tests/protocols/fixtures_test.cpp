// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/tcm2.h"
#include "tests/protocols/stream.h"

// Streams whose checksums were not computed by this code (fixtures/protocols/ORIGIN.md).
namespace navcal::protocols::test {
namespace {

template <Scanner S>
Outcome parsed_fixture(const std::string& name) {
  std::ifstream file(NAVCAL_SOURCE_DIR "/fixtures/protocols/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Buffer stream(text.begin(), text.end());
  const Outcome seen = all_at_once<S>(stream);
  EXPECT_EQ(byte_by_byte<S>(stream), seen);
  return seen;
}

using Counts = std::map<std::string, int>;

Counts counts_of(const Outcome& seen) {
  Counts counts;
  for (const Seen& frame : seen.frames) ++counts[std::string(frame.id.view())];
  return counts;
}

TEST(Fixtures, Tcm2) {
  const Outcome seen = parsed_fixture<tcm2::Scanner>("tcm2.raw");
  EXPECT_EQ(counts_of(seen), (Counts{{"WORD", 7}, {"REPLY", 4}, {"HCHDM", 1}, {"BANNER", 1}}));
  EXPECT_EQ(seen.bad_checksum, 1U);
  EXPECT_EQ(seen.held, 9U);
  std::vector<tcm2::Word> words;
  for (const Seen& frame : seen.frames) {
    if (frame.id != tcm2::kWord) continue;
    const auto word = tcm2::decode_word(frame.bytes);
    ASSERT_TRUE(word);
    words.push_back(*word);
  }
  EXPECT_EQ(words[3], (tcm2::Word{.pitch = 1.5, .roll = 12.8, .error = 0x002}));
  EXPECT_EQ(words[4], (tcm2::Word{.heading = 6399, .pitch = -1600, .roll = 1600}));
  EXPECT_EQ(words[5], (tcm2::Word{12.05, 0.1, -0.1, 9999.99, -9999.99, 0, 71.6, 0x200}));
}

TEST(Fixtures, ImuCard) {
  const Outcome seen = parsed_fixture<imu_card::Scanner>("imu_card.raw");
  EXPECT_EQ(counts_of(seen), (Counts{{"IMU", 4}}));
  EXPECT_EQ(seen.held, 7U);
  EXPECT_EQ(imu_card::decode_record(seen.frames[0].bytes)->raw[7], 4000);
  EXPECT_EQ(imu_card::decode_record(seen.frames[3].bytes)->status, imu_card::over_range | imu_card::low_supply);
}

TEST(Fixtures, MotorCard) {
  const Outcome seen = parsed_fixture<motor_card::Scanner>("motor_card.raw");
  EXPECT_EQ(counts_of(seen), (Counts{{"MCS", 4}, {"MCC", 1}}));
  EXPECT_EQ(seen.bad_checksum, 1U);
  EXPECT_EQ(motor_card::decode_status(seen.frames[0].bytes)->rpm, 1487);
  EXPECT_FALSE(motor_card::decode_status(seen.frames[4].bytes)) << "a sequence number of 300";
}

}  // namespace
}  // namespace navcal::protocols::test
