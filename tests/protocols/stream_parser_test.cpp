// SPDX-License-Identifier: Apache-2.0
#include "protocols/stream_parser.h"

#include <gtest/gtest.h>

#include "tests/protocols/gps_samples.h"
#include "tests/protocols/samples.h"
#include "tests/protocols/stream.h"

namespace navcal::protocols::test {
namespace {

template <class S>
class StreamParserOf : public testing::Test {
 protected:
  static constexpr std::uint64_t kStreams = 60;

  static Buffer stream(std::uint64_t seed) {
    Random random(seed);
    return mixture(random, random_frame<S>, 40);
  }
};

using Scanners = testing::Types<tcm2::Scanner, tcm2::CommandScanner, imu_card::Scanner, motor_card::Scanner,
                                oncore::Scanner, oncore::CommandScanner, nmea::Scanner, GpsStreamScanner>;
TYPED_TEST_SUITE(StreamParserOf, Scanners);

TYPED_TEST(StreamParserOf, ResultDoesNotDependOnTheCuts) {
  for (std::uint64_t seed = 0; seed < this->kStreams; ++seed) {
    const Buffer stream = this->stream(seed);
    const Outcome expected = all_at_once<TypeParam>(stream);
    ASSERT_GT(expected.frames.size(), 5U);
    EXPECT_EQ(byte_by_byte<TypeParam>(stream), expected) << "byte by byte, seed " << seed;
    Random random(seed + 1000);
    for (const std::size_t longest : {2UL, 3UL, 7UL, 30UL, 200UL}) {
      const auto in_pieces = run_in_pieces<TypeParam>(stream, [&] { return below(random, longest + 1); });
      EXPECT_EQ(in_pieces.outcome(), expected) << "pieces up to " << longest << ", seed " << seed;
    }
  }
}

TYPED_TEST(StreamParserOf, EveryPairOfCutsGivesTheSame) {
  const Buffer stream = [] {
    Random random(5);
    return mixture(random, random_frame<TypeParam>, 4);
  }();
  const Outcome expected = all_at_once<TypeParam>(stream);
  for (std::size_t first = 0; first <= stream.size(); ++first) {
    for (std::size_t second = first; second <= stream.size(); ++second) {
      Run<TypeParam> run;
      const Bytes all(stream);
      run.feed(all.first(first));
      run.feed(all.subspan(first, second - first));
      run.feed(all.subspan(second));
      ASSERT_EQ(run.outcome(), expected) << "cut at " << first << " and " << second;
    }
  }
}

TYPED_TEST(StreamParserOf, FramesLieInTheStreamWhereTheySay) {
  const Buffer stream = this->stream(7);
  std::uint64_t end_of_last = 0;
  for (const Seen& frame : byte_by_byte<TypeParam>(stream).frames) {
    ASSERT_GE(frame.offset, end_of_last);
    end_of_last = frame.offset + frame.bytes.size();
    ASSERT_LE(end_of_last, stream.size());
    EXPECT_TRUE(std::equal(frame.bytes.begin(), frame.bytes.end(),
                           stream.begin() + static_cast<std::ptrdiff_t>(frame.offset)));
  }
}

TYPED_TEST(StreamParserOf, AFrameAloneIsTheSameFrame) {
  for (const Seen& frame : all_at_once<TypeParam>(this->stream(8)).frames) {
    const Outcome alone = all_at_once<TypeParam>(frame.bytes);
    ASSERT_EQ(alone.frames.size(), 1U);
    EXPECT_EQ(alone.frames[0], (Seen{frame.id, 0, frame.bytes}));
  }
}

TYPED_TEST(StreamParserOf, EveryFrameBetweenHarmlessNoiseIsFound) {
  Random random(9);
  Buffer stream;
  std::vector<Buffer> sent;
  for (int i = 0; i < 200; ++i) {
    stream.insert(stream.end(), below(random, 4), std::uint8_t{0});
    sent.push_back(random_frame<TypeParam>(random));
    append(stream, sent.back());
  }
  const Outcome seen = byte_by_byte<TypeParam>(stream);
  ASSERT_EQ(seen.frames.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(seen.frames[i].bytes, sent[i]);
  EXPECT_EQ(seen.bad_checksum, 0U);
}

TYPED_TEST(StreamParserOf, BytesAreAccountedForAfterEveryCall) {
  for (std::uint64_t seed = 0; seed < this->kStreams; ++seed) {
    const Buffer stream = this->stream(seed);
    Random random(seed);
    Run<TypeParam> run;
    for (Bytes rest(stream); !rest.empty();) {
      const std::size_t length = std::min(rest.size(), below(random, 20));
      run.feed(rest.first(length));
      rest = rest.subspan(length);
      ASSERT_TRUE(run.all_bytes_accounted_for());
      if (below(random, 10) == 0) run.silence();
      ASSERT_TRUE(run.all_bytes_accounted_for());
    }
    EXPECT_EQ(run.parser().counters().bytes, stream.size());
  }
}

TYPED_TEST(StreamParserOf, SilenceReleasesAWholeFrameBehindACutOne) {
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    Buffer cut = random_frame<TypeParam>(random);
    cut.resize(1 + below(random, cut.size() - 1));
    const Buffer whole = random_frame<TypeParam>(random);
    Run<TypeParam> run;
    run.feed(cut);
    run.feed(whole);
    for (std::size_t calls = 0; run.parser().held() > 0; ++calls) {
      ASSERT_LT(calls, cut.size() + whole.size());
      run.silence();
    }
    ASSERT_TRUE(run.all_bytes_accounted_for());
    ASSERT_FALSE(run.frames().empty());
    // The end of the cut one may have become the beginning of a line together with the whole one; it ends with it.
    const Seen& last = run.frames().back();
    EXPECT_EQ(last.offset + last.bytes.size(), cut.size() + whole.size());
  }
}

TYPED_TEST(StreamParserOf, FewerThanTheMissingBytesNeverCompleteWhatIsHeld) {
  const Buffer stream = this->stream(12);
  Run<TypeParam> run;
  std::size_t promised = 0;  // total bytes before which nothing can be completed
  std::uint64_t held_from = 0;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const std::size_t frames_before = run.frames().size();
    run.feed({&stream[i], 1});
    const bool completed = run.frames().size() > frames_before && run.frames().back().offset == held_from;
    if (completed) {
      EXPECT_GE(i + 1, promised);
    }
    promised = run.parser().held() > 0 ? i + 1 + run.parser().missing() : 0;
    held_from = run.parser().position();
    EXPECT_EQ(run.parser().missing() == 0, run.parser().held() == 0);
  }
}

TYPED_TEST(StreamParserOf, NothingInNothingOut) {
  Run<TypeParam> run;
  run.feed({});
  run.silence();
  EXPECT_EQ(run.outcome(), Outcome{});
}

TYPED_TEST(StreamParserOf, AnEmptyReadForgetsNothing) {
  Random random(13);
  const Buffer frame = random_frame<TypeParam>(random);
  Run<TypeParam> run;
  run.feed(Bytes(frame).first(frame.size() - 1));
  run.feed({});
  run.feed(Bytes(frame).last(1));
  ASSERT_EQ(run.frames().size(), 1U);
  EXPECT_EQ(run.frames()[0].bytes, frame);
}

}  // namespace
}  // namespace navcal::protocols::test
