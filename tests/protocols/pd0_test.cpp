// SPDX-License-Identifier: Apache-2.0
#include "protocols/pd0.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/protocols/pd0_samples.h"
#include "tests/protocols/shared_capture.h"

namespace navcal::protocols::test {
namespace {

TEST(Pd0, WhatIsEncodedIsDecoded) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const pd0::Ensemble ensemble = random_ensemble(random);
    EXPECT_EQ(pd0::decode(pd0::encode(ensemble)), ensemble);
  }
}

TEST(Pd0, FramesDoNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    EXPECT_TRUE(same_however_cut<pd0::Scanner>(mixture(random, random_frame<pd0::Scanner>, 30)));
  }
}

TEST(Pd0, EveryCutAndEveryFlippedBit) {
  Random random(4);
  Buffer stream = pd0::encode(random_ensemble(random));
  append(stream, pd0::encode(random_ensemble(random)));
  EXPECT_TRUE(every_cut_gives_a_prefix<pd0::Scanner>(stream));
  EXPECT_TRUE(every_flipped_bit_shows<pd0::Scanner>(pd0::encode(random_ensemble(random))));
}

TEST(Pd0, UnknownAndShortTypesAreCounted) {
  Buffer short_bottom(20);
  short_bottom[1] = 0x06;
  const pd0::Ensemble seen = pd0::decode(pd0::encode_types({Buffer(40, 0x11), short_bottom}));
  EXPECT_EQ(seen.unknown_types, 1U);
  EXPECT_EQ(seen.invalid_types, 1U);
  Buffer frame = pd0::encode_types({Buffer(40), Buffer(40)});
  frame[7] = 0xFF;  // the first offset lies beyond the end
  EXPECT_GE(pd0::decode(frame).invalid_types, 1U);
}

/// Two bytes of the capture, the lower first, as the manual numbers them from 1.
int word_of(const Buffer& bytes, std::size_t type, std::size_t byte_number) {
  return bytes[type + byte_number - 1] + 256 * bytes[type + byte_number];
}

TEST(Pd0, CapturesByOthers) {
  const std::pair<const char*, std::size_t> files[] = {
      {"RDI_withBT.000", 1721}, {"adcp_auv_51.pd0", 51}, {"NE051400.PD0", 193}};
  for (const auto& [name, count] : files) {
    const Buffer stream = shared_capture(std::string("pd0/") + name);
    if (stream.empty()) GTEST_SKIP() << "no captures of Doppler logs here";
    const Outcome seen = all_at_once<pd0::Scanner>(stream);
    EXPECT_EQ(seen.frames.size(), count) << name;
    EXPECT_TRUE(same_however_cut<pd0::Scanner>(stream)) << name;
    std::uint32_t before = 0;
    for (const Seen& frame : seen.frames) {
      const pd0::Ensemble ensemble = pd0::decode(frame.bytes);
      ASSERT_TRUE(ensemble.fixed && ensemble.variable && ensemble.bottom) << name;
      EXPECT_EQ(ensemble.invalid_types, 0U);
      EXPECT_GT(ensemble.variable->ensemble, before) << "ensembles are numbered";
      before = ensemble.variable->ensemble;
      EXPECT_TRUE(is_valid(ensemble.variable->date)) << name;
      for (std::size_t i = 0; i < frame.bytes[5]; ++i) {
        const auto at = static_cast<std::size_t>(word_of(frame.bytes, 7 + 2 * i - 1, 1));
        const int type = word_of(frame.bytes, at, 1);
        if (type == 0x0080) {
          EXPECT_NEAR(ensemble.variable->heading_deg, word_of(frame.bytes, at, 19) / 100.0, 1e-9);
          EXPECT_NEAR(ensemble.variable->speed_of_sound_m_s, word_of(frame.bytes, at, 15), 1e-9);
        }
        if (type != 0x0600) continue;
        for (std::size_t beam = 0; beam < 4; ++beam) {
          int velocity = word_of(frame.bytes, at, 25 + 2 * beam);
          if (velocity > 32767) velocity -= 65536;
          EXPECT_EQ(ensemble.bottom->velocity_m_s[beam].has_value(), velocity != -32768);
          if (velocity != -32768) {
            EXPECT_NEAR(*ensemble.bottom->velocity_m_s[beam], velocity / 1000.0, 1e-9);
          }
          if (word_of(frame.bytes, at, 17 + 2 * beam) != 0 && frame.bytes[at + 77 + beam] == 0) {
            EXPECT_NEAR(*ensemble.bottom->range_m[beam], word_of(frame.bytes, at, 17 + 2 * beam) / 100.0, 1e-9);
          }
        }
      }
    }
  }
}

TEST(Pd0, TheSystemWordOfTheFixedLeader) {
  pd0::FixedLeader fixed;
  EXPECT_FALSE(fixed.looks_up() || fixed.is_convex());
  EXPECT_EQ(fixed.beam_angle_deg(), 15);
  fixed.system = 0x0108;
  EXPECT_TRUE(fixed.is_convex());
  EXPECT_FALSE(fixed.looks_up());
  EXPECT_EQ(fixed.beam_angle_deg(), 20);
  fixed.system = 0x0280;
  EXPECT_FALSE(fixed.is_convex());
  EXPECT_TRUE(fixed.looks_up());
  EXPECT_EQ(fixed.beam_angle_deg(), 30);
  fixed.system = 0x0300;
  EXPECT_FALSE(fixed.beam_angle_deg()) << "other, and the leader is too short to say which";
  fixed.stated_beam_angle_deg = 25;
  EXPECT_EQ(fixed.beam_angle_deg(), 25);
  fixed.stated_beam_angle_deg = 90;
  EXPECT_FALSE(fixed.beam_angle_deg());
}

}  // namespace
}  // namespace navcal::protocols::test
