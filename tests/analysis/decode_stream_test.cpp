// SPDX-License-Identifier: Apache-2.0
#include "analysis/decode_stream.h"

#include <gtest/gtest.h>

#include "protocols/gps_stream.h"
#include "protocols/oncore_encode.h"

namespace navcal::cli {
namespace {

using protocols::Bytes;
namespace oncore = protocols::oncore;
using Buffer = std::vector<std::uint8_t>;

struct Decoded {
  analysis::DecodeSummary summary;
  std::vector<std::uint64_t> offsets;
};

Decoded decode_in_pieces(const Buffer& stream, std::size_t piece) {
  Decoded decoded;
  Bytes rest(stream);
  decoded.summary = analysis::decode_stream<oncore::Scanner>(
      [&] {
        const Bytes next = rest.first(std::min(piece, rest.size()));
        rest = rest.subspan(next.size());
        return next;
      },
      [&](const protocols::Frame& frame) { decoded.offsets.push_back(frame.offset); });
  return decoded;
}

Buffer ea() { return oncore::encode_ea({}); }
Buffer bo() { return oncore::encode_bo({std::int8_t{18}}); }
Buffer first(Buffer bytes, std::size_t n) {
  bytes.resize(n);
  return bytes;
}
Buffer joined(std::initializer_list<Buffer> parts) {
  Buffer all;
  for (const Buffer& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void expect_accounts(const Decoded& decoded, std::uint64_t framed, std::uint64_t skipped,
                     std::uint64_t incomplete) {
  EXPECT_EQ(decoded.summary.counters.framed_bytes, framed);
  EXPECT_EQ(decoded.summary.skipped_bytes(), skipped);
  EXPECT_EQ(decoded.summary.incomplete_bytes, incomplete);
  EXPECT_EQ(decoded.summary.counters.bytes, framed + skipped + incomplete);
}

TEST(DecodeStream, AnEmptyStreamIsNothing) { expect_accounts(decode_in_pieces({}, 1), 0, 0, 0); }

TEST(DecodeStream, AFrameCutByTheEndIsIncomplete) {
  for (std::size_t kept = 1; kept < 76; ++kept)
    expect_accounts(decode_in_pieces(joined({bo(), first(ea(), kept)}), 4096), 8, 0, kept);
}

TEST(DecodeStream, WholeFramesBehindACutOneAreFoundAtTheEnd) {
  const auto decoded = decode_in_pieces(joined({first(ea(), 30), bo(), bo()}), 4096);
  EXPECT_EQ(decoded.offsets, (std::vector<std::uint64_t>{30, 38}));
  expect_accounts(decoded, 16, 30, 0);
}

TEST(DecodeStream, BothAtOnce) {
  const auto decoded = decode_in_pieces(joined({first(ea(), 30), bo(), Buffer(5, 0), first(ea(), 10)}), 4096);
  EXPECT_EQ(decoded.offsets, (std::vector<std::uint64_t>{30}));
  expect_accounts(decoded, 8, 35, 10);
}

TEST(DecodeStream, NoiseAtTheEndIsSkippedAndNotIncomplete) {
  expect_accounts(decode_in_pieces(joined({bo(), Buffer(50, 0)}), 4096), 8, 50, 0);
  expect_accounts(decode_in_pieces(joined({bo(), Buffer{'@', '@', 'Z'}}), 4096), 8, 3, 0);
  expect_accounts(decode_in_pieces(joined({bo(), Buffer{'x', '@'}}), 4096), 8, 1, 1);
}

TEST(DecodeStream, TheSameHoweverTheInputIsCut) {
  const Buffer stream =
      joined({Buffer{'#', '@'}, first(ea(), 40), bo(), ea(), first(ea(), 70), bo(), first(ea(), 9)});
  const auto whole = decode_in_pieces(stream, stream.size());
  EXPECT_EQ(whole.summary.frames.at(oncore::kBo), 2U);
  EXPECT_EQ(whole.summary.frames.at(oncore::kEa), 1U);
  for (std::size_t piece = 1; piece < stream.size(); ++piece) {
    const auto decoded = decode_in_pieces(stream, piece);
    EXPECT_EQ(decoded.offsets, whole.offsets);
    EXPECT_EQ(decoded.summary.frames, whole.summary.frames);
    expect_accounts(decoded, whole.summary.counters.framed_bytes, whole.summary.skipped_bytes(),
                    whole.summary.incomplete_bytes);
  }
}

}  // namespace
}  // namespace navcal::cli
