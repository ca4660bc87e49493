// SPDX-License-Identifier: Apache-2.0
// What StreamParser demands of every scanner, of devices that a file describes.
#include <gtest/gtest.h>

#include "protocols/checked_line.h"
#include "protocols/described/reading.h"
#include "protocols/imu_card.h"
#include "protocols/nmea.h"
#include "tests/protocols/described_samples.h"
#include "tests/protocols/samples.h"
#include "tests/protocols/text.h"

namespace navcal::protocols::described::test {
namespace {

using protocols::test::append;
using protocols::test::mixture;
using protocols::test::Outcome;
using DescribedRun = protocols::test::Run<Scanner>;

Buffer text_bytes(std::string_view text) { return {text.begin(), text.end()}; }

Outcome whole(const Description& device, Bytes stream) {
  return protocols::test::all_at_once<Scanner>(stream, scanner_of(device));
}

class DescribedScanner : public testing::TestWithParam<NamedDevice> {
 protected:
  const Description& device = GetParam().description;
  [[nodiscard]] Buffer stream_of(std::uint64_t seed, std::size_t pieces) const {
    Random random(seed);
    return mixture(
        random, [&](Random& inner) { return random_frame(inner, device); }, pieces);
  }
};

TEST_P(DescribedScanner, FindsEveryFrameThatWasEncoded) {
  Random random(1);
  Buffer stream = text_bytes(";\r\n");  // a line may begin
  const std::size_t before = stream.size();
  for (int i = 0; i < 300; ++i) append(stream, random_frame(random, device));
  const Outcome seen = whole(device, stream);
  EXPECT_EQ(seen.frame_count, 300U);
  EXPECT_EQ(seen.bad_checksum, 0U);
  EXPECT_EQ(seen.skipped_bytes, before);
}

TEST_P(DescribedScanner, FindsTheSameHoweverTheBytesAreCut) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Buffer stream = stream_of(seed, 25);
    const Outcome once = whole(device, stream);
    EXPECT_EQ(protocols::test::byte_by_byte<Scanner>(stream, scanner_of(device)), once) << seed;
    Random random(seed);
    const auto cut = protocols::test::run_in_pieces<Scanner>(
        stream, [&] { return 1 + below(random, 40); }, scanner_of(device));
    EXPECT_EQ(cut.outcome(), once) << seed;
    EXPECT_TRUE(cut.all_bytes_accounted_for());
  }
}

TEST_P(DescribedScanner, IsTheSameCutAtEachByte) {
  const Buffer stream = stream_of(99, 12);
  const Outcome once = whole(device, stream);
  for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
    DescribedRun run(scanner_of(device));
    run.feed(Bytes(stream).first(cut));
    run.feed(Bytes(stream).subspan(cut));
    ASSERT_EQ(run.outcome(), once) << cut;
  }
}

TEST_P(DescribedScanner, NeverHoldsMoreThanItsBufferAndGivesUpInSilence) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Buffer stream = stream_of(seed, 20);
    DescribedRun run(scanner_of(device));
    for (const std::uint8_t byte : stream) {
      run.feed({&byte, 1});
      ASSERT_LE(run.parser().held() + run.parser().missing(), Scanner::kMaxFrameLength);
      ASSERT_EQ(run.parser().held() == 0, run.parser().missing() == 0);
    }
    while (run.parser().held() > 0) run.silence();
    EXPECT_TRUE(run.all_bytes_accounted_for());
  }
}

TEST_P(DescribedScanner, NoFrameSurvivesAFlippedBitUnderAChecksum) {
  Random random(5);
  for (const FrameKind& kind : device.kinds) {
    if (kind.checksum.sum == Sum::none) GTEST_SKIP() << "it has no checksum";
    const Buffer frame = encode(device, kind, random_values(random, kind));
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      Buffer flipped = frame;
      flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      // Hexadecimal digits are of either case, and <CR> may be missing: what is left is the same frame.
      const Outcome seen = whole(device, flipped);
      for (const auto& found : seen.frames) {
        const auto plan = compile(device);
        std::vector<double> values(kind.fields.size()), expected(kind.fields.size());
        FrameReader(kind, device.is_text).read_plain(found.bytes, values);
        FrameReader(kind, device.is_text).read_plain(frame, expected);
        EXPECT_EQ(values, expected) << "bit " << bit;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, DescribedScanner, testing::ValuesIn(all_devices()),
                         [](const auto& device) { return device.param.name; });

TEST(DescribedScannerOf, AnIndescribedDeviceFindsNothing) {
  DescribedRun run;
  run.feed(text_bytes("$IIDPT,1.0,*00\r\n"));
  EXPECT_EQ(run.outcome().skipped_bytes, 16U);
}

TEST(DescribedScannerOf, TheInertialCardAgreesWithItsDriver) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Buffer stream = mixture(
        random,
        [](Random& inner) {
          const auto frame = imu_card::encode_record(protocols::test::random_record(inner));
          return Buffer(frame.begin(), frame.end());
        },
        40);
    EXPECT_EQ(whole(inertial_card(), stream), protocols::test::all_at_once<imu_card::Scanner>(stream)) << seed;
  }
}

TEST(DescribedScannerOf, ACheckedLineAgreesWithItsDriver) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Buffer stream = mixture(
        random,
        [](Random& inner) { return checked_line("IIDPT," + std::to_string(below(inner, 1000)) + ".5,0.3"); }, 40);
    const Outcome mine = whole(checked_lines(), stream);
    Outcome drivers = protocols::test::all_at_once<nmea::Scanner>(stream);
    std::erase_if(drivers.frames, [](const auto& frame) { return frame.id.view() != "IIDPT"; });
    EXPECT_EQ(mine.frames, drivers.frames) << seed;
  }
}

TEST(DescribedScannerOf, ABareLineIsTakenOnlyBehindTheEndOfAnother) {
  const Outcome seen = whole(bare_lines(), text_bytes("2.5,3,4\n12.5,3,4\r\n1,2,3,4\n\n7,8,9\n5,6"));
  ASSERT_EQ(seen.frames.size(), 2U);
  EXPECT_EQ(seen.frames[0].bytes, text_bytes("12.5,3,4\r\n"));
  EXPECT_EQ(seen.frames[1].bytes, text_bytes("7,8,9\n"));
  EXPECT_EQ(seen.held, 3U);
}

TEST(DescribedScannerOf, TheRestOfALineThatWasGivenUpIsNoLine) {
  DescribedRun run(scanner_of(bare_lines()));
  run.feed(text_bytes("\n12"));
  run.silence();
  run.feed(text_bytes("3.5,3,4\n1,2,3\n"));
  ASSERT_EQ(run.frames().size(), 1U);
  EXPECT_EQ(run.frames()[0].bytes, text_bytes("1,2,3\n"));
}

TEST(DescribedScannerOf, ALineThatWasCutByTheNextOneDoesNotTakeIt) {
  const Buffer line = encode(keyed_lines(), keyed_lines().kinds[0], std::vector<double>{1, 2});
  Buffer stream(line.begin(), line.begin() + 4);
  append(stream, line);
  EXPECT_EQ(whole(keyed_lines(), stream).frame_count, 1U);
}

TEST(DescribedScannerOf, ALengthThatCannotBeIsNoFrame) {
  const Description device = two_kinds();
  Buffer frame = encode(device, device.kinds[1], std::vector<double>{1, 2});
  frame[3] = 0xFF;
  const Outcome seen = whole(device, frame);
  EXPECT_EQ(seen.frame_count + seen.bad_checksum + seen.held, 0U);
}

TEST(DescribedScannerOf, NothingIsCompletedBeforeTheBytesThatItMisses) {
  for (const NamedDevice& device : all_devices()) {
    Random random(3);
    Buffer stream = text_bytes("\n");
    for (int i = 0; i < 20; ++i) append(stream, random_frame(random, device.description));
    DescribedRun run(scanner_of(device.description));
    std::size_t promised = 0;
    for (std::size_t i = 0; i < stream.size(); ++i) {
      const std::size_t before = run.frames().size();
      run.feed({&stream[i], 1});
      if (run.frames().size() > before) {
        EXPECT_GE(i + 1, promised) << device.name;
      }
      promised = run.parser().held() > 0 ? i + 1 + run.parser().missing() : 0;
    }
    EXPECT_EQ(run.frames().size(), 20U) << device.name;
  }
}

TEST(DescribedScannerOf, AFrameThatStatesTooShortALengthIsNone) {
  const Description device = two_kinds();
  // The start, the length of two bytes and four of the checksum.
  EXPECT_EQ(least_length(device.kinds[1]), 8U);
  EXPECT_EQ(least_length(device.kinds[0]), device.kinds[0].length.fixed);
  Buffer frame = encode(device, device.kinds[1], std::vector<double>{1, 2});
  frame[2] = frame[3] = 0;  // six bytes
  const Outcome seen = whole(device, frame);
  EXPECT_EQ(seen.frame_count + seen.bad_checksum + seen.held, 0U);
  DescribedRun run(scanner_of(device));
  run.feed(Bytes(frame).first(2));
  EXPECT_EQ(run.parser().missing(), 6U);
}

}  // namespace
}  // namespace navcal::protocols::described::test
