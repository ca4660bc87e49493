// SPDX-License-Identifier: Apache-2.0
#include "link/frame.h"

#include <gtest/gtest.h>

#include <random>

#include "link/arrivals.h"
#include "link/budget.h"

namespace navcal::link {
namespace {

Buffer sample_frame(std::size_t payload, bool is_tagged, unsigned seed) {
  std::minstd_rand random(seed + 1);
  Buffer bytes(payload);
  for (auto& byte : bytes) byte = random() % 4 == 0 ? kSync0 : static_cast<std::uint8_t>(random() >> 5);
  const auto type = static_cast<FrameType>(1 + seed % kFrameTypes);
  const std::array<std::uint8_t, kTagLength> tag{1, 2, 3, 4, 5, 6, kSync0, kSync1};
  FrameWriter writer({type, is_tagged, static_cast<std::uint16_t>(seed * 7), seed}, bytes);
  return std::move(writer).finish(is_tagged ? Bytes(tag) : Bytes());
}

std::vector<Buffer> found_in(const std::vector<Bytes>& pieces) {
  std::vector<Buffer> found;
  Parser parser;
  std::uint64_t fed = 0;
  for (const Bytes piece : pieces) {
    parser.feed(piece, [&](const protocols::Frame& f) { found.emplace_back(f.bytes.begin(), f.bytes.end()); });
    fed += piece.size();
    const auto& c = parser.counters();
    EXPECT_EQ(c.bytes, fed);
    EXPECT_EQ(c.framed_bytes + c.skipped_bytes + parser.held(), fed);
  }
  return found;
}

TEST(LinkFrame, ComesBackAsItWasMade) {
  for (const std::size_t payload : {std::size_t{0}, std::size_t{1}, std::size_t{87}, kMaxPayload}) {
    for (unsigned seed = 0; seed < 2 * kFrameTypes; ++seed) {
      const bool is_tagged = seed % 2 == 1;
      const Buffer frame = sample_frame(payload, is_tagged, seed);
      const auto view = view_frame(frame);
      ASSERT_TRUE(view);
      EXPECT_EQ(static_cast<unsigned>(view->header.type), 1 + seed % kFrameTypes);
      EXPECT_EQ(view->header.is_tagged, is_tagged);
      EXPECT_EQ(view->header.session, seed * 7);
      EXPECT_EQ(view->header.counter, seed);
      EXPECT_EQ(view->payload.size(), payload);
      EXPECT_EQ(view->tag.size(), is_tagged ? kTagLength : 0);
      EXPECT_EQ(frame.size(), kHeaderLength + payload + view->tag.size() + kCrcLength);
    }
  }
}

TEST(LinkFrame, EveryCutOfAStreamGivesTheSameFrames) {
  Buffer stream{kSync0, 9, kSync0};
  std::vector<Buffer> frames;
  for (unsigned seed = 0; seed < 4; ++seed) {
    frames.push_back(sample_frame(5 + 9 * seed, seed % 2 == 0, seed));
    stream.insert(stream.end(), frames.back().begin(), frames.back().end());
    if (seed == 1) stream.insert(stream.end(), {kSync0, kSync1, 1 << 4 | 7});  // one that is cut short
  }
  for (std::size_t cut = 0; cut <= stream.size(); ++cut)
    ASSERT_EQ(found_in({Bytes(stream).first(cut), Bytes(stream).subspan(cut)}), frames) << cut;
  std::vector<Bytes> single;
  for (std::size_t i = 0; i < stream.size(); ++i) single.push_back(Bytes(stream).subspan(i, 1));
  EXPECT_EQ(found_in(single), frames);
}

TEST(LinkFrame, AFlippedBitIsNoFrameAndTheNextFrameIsFound) {
  const Buffer frame = sample_frame(30, true, 6);
  const Buffer next = sample_frame(3, false, 2);
  Buffer rest(kMaxFrame, 0);  // so that a wrong length ends
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Buffer wrong = frame;
    wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_FALSE(view_frame(wrong)) << bit;
    ASSERT_EQ(found_in({wrong, next, rest}), std::vector<Buffer>{next}) << bit;
  }
}

TEST(LinkFrame, IsFoundBehindGarbage) {
  std::minstd_rand random(4);
  for (unsigned round = 0; round < 200; ++round) {
    Buffer noise(random() % 300);
    for (auto& byte : noise) byte = random() % 3 == 0 ? kSync0 : static_cast<std::uint8_t>(random() >> 3);
    const Buffer frame = sample_frame(random() % kMaxPayload, round % 2 == 0, round);
    const Buffer rest(kMaxFrame, 0);
    ASSERT_EQ(found_in({noise, frame, rest}), std::vector<Buffer>{frame});
  }
}

TEST(LinkFrame, ATruncatedOneDoesNotTakeTheNextWithIt) {
  const Buffer frame = sample_frame(40, true, 3);
  for (std::size_t length = 0; length < frame.size(); ++length) {
    const Buffer rest(kMaxFrame, 0);
    ASSERT_EQ(found_in({Bytes(frame).first(length), frame, rest}), std::vector<Buffer>{frame}) << length;
  }
}

TEST(LinkArrivals, TakesEachCounterOnceInAnyOrderWithinTheWindow) {
  Arrivals arrivals;
  EXPECT_FALSE(arrivals.take(0));
  EXPECT_TRUE(arrivals.take(3));
  EXPECT_TRUE(arrivals.take(1));
  EXPECT_FALSE(arrivals.take(3));
  EXPECT_FALSE(arrivals.take(1));
  EXPECT_TRUE(arrivals.take(2));
  EXPECT_EQ(arrivals.loss(), 0);
  EXPECT_TRUE(arrivals.take(200));
  EXPECT_FALSE(arrivals.take(136)) << "64 behind";
  EXPECT_TRUE(arrivals.take(137));
  EXPECT_DOUBLE_EQ(arrivals.loss(), 1 - 2 / 64.0);
  EXPECT_TRUE(arrivals.take(UINT32_MAX));
  EXPECT_FALSE(arrivals.take(5));
}

TEST(LinkBudget, HoldsTheRateAndTellsWhenItIsReady) {
  Budget budget(1000);
  std::int64_t now_ns = 0;
  double passed = 0;
  std::minstd_rand random(1);
  for (int i = 0; i < 2000; ++i) {
    const std::size_t bytes = 20 + random() % 200;
    const bool is_urgent = random() % 4 == 0;
    if (budget.allows(now_ns, bytes, is_urgent)) {
      budget.spend(bytes);
      passed += static_cast<double>(bytes);
    } else {
      const std::int64_t ready_ns = budget.ready_ns(bytes, is_urgent);
      ASSERT_GT(ready_ns, now_ns);
      ASSERT_FALSE(budget.allows(ready_ns - 1000, bytes, is_urgent));
      now_ns = ready_ns;
      ASSERT_TRUE(budget.allows(now_ns, bytes, is_urgent));
    }
    ASSERT_LE(passed, 1000 * static_cast<double>(now_ns) * 1e-9 + Budget::kBurst + Budget::kDebt);
  }
  EXPECT_GT(now_ns, 100'000'000'000);
}

}  // namespace
}  // namespace navcal::link
