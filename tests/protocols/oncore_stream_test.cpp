// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "protocols/oncore.h"
#include "protocols/oncore_encode.h"
#include "tests/protocols/gps_samples.h"
#include "tests/protocols/gps_text.h"

// The traps of ICD section 2.
namespace navcal::protocols::test {
namespace {

Outcome parsed_oncore(const Buffer& stream) { return all_at_once<oncore::Scanner>(stream); }

Buffer ea() {
  Random random(1);
  return oncore::encode_ea(random_position(random));
}

Buffer bo() { return oncore::encode_bo({std::int8_t{18}}); }

TEST(OncoreStream, EveryKnownResponseIsFramedByItsLetters) {
  const std::pair<std::string_view, std::size_t> known[] = {
      {"Aa", 10}, {"Ap", 25},  {"As", 20}, {"AB", 8},  {"AQ", 8},   {"Ba", 68},  {"Bb", 92},
      {"Bd", 23}, {"Bn", 59},  {"Cc", 80}, {"Cf", 7},  {"Cj", 294}, {"Co", 29},  {"Ea", 76},
      {"Ek", 71}, {"En", 69},  {"Gb", 17}, {"Gj", 21}, {"Gk", 13},  {"Ha", 154}, {"Hb", 54},
      {"Hn", 78}, {"Hr", 170}, {"Ia", 10}, {"Sz", 8},
  };
  for (const auto& [letters, length] : known) {
    const Buffer frame = oncore::encode_frame(FrameId(letters), Buffer(length - 7, 0x55));
    const Outcome seen = parsed_oncore(joined({frame, bo()}));
    EXPECT_EQ(ids(seen), std::string(letters) + " Bo ");
    EXPECT_EQ(seen.frames.at(0).bytes.size(), length);
    EXPECT_EQ(seen.skipped_bytes, 0U);
  }
}

TEST(OncoreStream, AnUnknownIdentifierSwallowsNothing) {
  for (const std::string_view letters : {"Ci", "Zz", "aa", "E@", "E_", "HA", "Eb"}) {
    const Outcome seen = parsed_oncore(joined({buffer_of("@@" + std::string(letters)), ea()}));
    EXPECT_EQ(ids(seen), "Ea ") << letters;
    EXPECT_EQ(seen.skipped_bytes, 4U);
    EXPECT_EQ(seen.bad_checksum, 0U);
  }
}

TEST(OncoreStream, LineEndsAndSyncInsideThePayload) {
  const Buffer data = buffer_of("\r\n@@Ea\r\n@@Bo\r\n");
  const Outcome seen = parsed_oncore(joined({oncore::encode_frame(oncore::kGj, data), ea()}));
  EXPECT_EQ(ids(seen), "Gj Ea ");
  EXPECT_EQ(seen.skipped_bytes, 0U);
}

TEST(OncoreStream, SyncInTextBeforeTheStream) {
  EXPECT_EQ(ids(parsed_oncore(
                joined({buffer_of("# mail to me@@Example, @@Ea was it\r\n@"), ea(), bo(), Buffer(100, 0)}))),
            "Ea Bo ");
  EXPECT_EQ(ids(parsed_oncore(joined({buffer_of("@@@@@"), bo()}))), "Bo ");
}

TEST(OncoreStream, AFailedFrameIsLeftByOneByte) {
  Buffer damaged = ea();
  damaged[20] ^= 1;
  const Buffer inner = bo();
  std::copy(inner.begin(), inner.end(), damaged.begin() + 40);
  const Outcome seen = parsed_oncore(joined({damaged, ea()}));
  EXPECT_EQ(ids(seen), "Bo Ea ") << "the whole frame inside the failed one is found";
  EXPECT_EQ(seen.bad_checksum, 1U);
  EXPECT_EQ(seen.skipped_bytes, damaged.size() - inner.size());
}

TEST(OncoreStream, EverySingleBitErrorIsSeen) {
  const Buffer frame = ea();
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Buffer damaged = frame;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    const Outcome seen = parsed_oncore(joined({damaged, Buffer(oncore::kMaxLength, 0)}));
    EXPECT_TRUE(seen.frames.empty()) << "bit " << bit;
  }
}

TEST(OncoreStream, ATruncatedFrameDoesNotHoldTheParserForEver) {
  const Buffer whole = ea();
  for (std::size_t kept = 1; kept < whole.size(); ++kept) {
    Buffer stream(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept));
    append(stream, bo());
    test::Run<oncore::Scanner> run;
    run.feed(stream);
    EXPECT_LE(run.parser().missing(), whole.size());
    while (run.parser().held() > 0) run.silence();
    ASSERT_EQ(run.frames().size(), 1U) << kept;
    EXPECT_EQ(run.frames()[0].offset, kept);
    EXPECT_TRUE(run.all_bytes_accounted_for());
  }
}

TEST(OncoreStream, TheFrameBehindATruncatedOneIsFoundWithoutSilenceOnceEnoughBytesFollow) {
  const Buffer whole = ea();
  const Buffer cut(whole.begin(), whole.begin() + 30);
  EXPECT_EQ(ids(parsed_oncore(joined({cut, whole, whole}))), "Ea Ea ");
}

TEST(OncoreStream, WrongTerminatorsAreCountedAsBad) {
  for (const std::size_t from_end : {1U, 2U}) {
    Buffer frame = bo();
    frame[frame.size() - from_end] = 'x';
    EXPECT_EQ(parsed_oncore(frame).bad_checksum, 1U);
    EXPECT_TRUE(parsed_oncore(frame).frames.empty());
  }
}

TEST(OncoreStream, AsciiPositionHasAChecksumOfThreeDigits) {
  const Buffer frame = ascii_position(kAsciiPosition);
  ASSERT_EQ(frame.size(), 96U);
  EXPECT_EQ(ids(parsed_oncore(frame)), "Eq ");

  // Some say that the last comma is not part of the sum.
  Buffer without_comma(frame.begin(), frame.end() - 5);
  const auto sum = static_cast<unsigned>(xor_of(Bytes(without_comma).subspan(2)) ^ ',');
  for (const unsigned digit : {sum / 100, sum / 10 % 10, sum % 10})
    without_comma.push_back(static_cast<std::uint8_t>('0' + digit));
  append(without_comma, buffer_of("\r\n"));
  EXPECT_EQ(ids(parsed_oncore(without_comma)), "Eq ");

  for (std::size_t i = 4; i < frame.size(); ++i) {
    Buffer damaged = frame;
    damaged[i] ^= 0x01;
    EXPECT_EQ(ids(parsed_oncore(damaged)), "") << i;
  }
}

}  // namespace
}  // namespace navcal::protocols::test
