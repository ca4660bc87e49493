// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_reader.h"

#include <gtest/gtest.h>

#include "record/recording.h"
#include "tests/record/memory_source.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

using testing::sample_log;

LogReader log_reader_of(std::string_view bytes) { return {std::make_unique<MemorySource>(bytes), "test.mcap"}; }

std::uint64_t messages_of(LogReader& reader) {
  std::uint64_t messages = 0;
  while (reader.next()) ++messages;
  return messages;
}

std::uint64_t whole_before(const testing::SampleLog& log, std::size_t cut) {
  // The configuration and the mapping are written by begin(), before the first end that is noted.
  std::uint64_t whole = log.messages - log.ends.size();
  for (const auto end : log.ends) whole += end <= cut ? 1U : 0U;
  return whole;
}

TEST(LogReader, ReadsWhatTheEncoderWrote) {
  const auto log = sample_log(3, true);
  LogReader reader = log_reader_of(log.bytes);
  EXPECT_EQ(messages_of(reader), log.messages);
  EXPECT_TRUE(reader.findings().finished);
  EXPECT_EQ(reader.findings().data_end, log.data_end);
  EXPECT_EQ(reader.findings().bad_crc, 0U);
  EXPECT_EQ(reader.log_offset_ns(), testing::kSampleOffset_ns);
  EXPECT_TRUE(reader.remarks().empty());
}

TEST(LogReader, EveryWholeMessageSurvivesACutAtEveryByte) {
  const auto log = sample_log(1, true);
  const std::size_t first = log.ends.front();
  for (std::size_t cut = first; cut < log.bytes.size(); ++cut) {
    LogReader reader = log_reader_of(std::string_view(log.bytes).substr(0, cut));
    ASSERT_EQ(messages_of(reader), whole_before(log, cut)) << cut;
    ASSERT_FALSE(reader.findings().finished) << cut;
    ASSERT_EQ(reader.findings().bad_crc, 0U) << cut;
    ASSERT_FALSE(reader.remarks().empty()) << cut;
  }
}

TEST(LogReader, AZeroTailIsSpaceTakenInAdvance) {
  const auto log = sample_log(1, false);
  const std::string bytes = log.bytes + std::string(100'000, '\0');
  LogReader zeros = log_reader_of(bytes);
  EXPECT_EQ(messages_of(zeros), log.messages);
  EXPECT_EQ(zeros.findings().tail_bytes, 100'000U);
  EXPECT_TRUE(zeros.findings().tail_is_zero);
  EXPECT_EQ(zeros.findings().data_end, log.data_end);
}

TEST(LogReader, AChangedByteCostsAtMostTheMessageItIsIn) {
  const auto log = sample_log(1, true);
  for (std::size_t at = log.ends[0]; at < log.ends[16]; ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      std::string bytes = log.bytes;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      LogReader reader = log_reader_of(bytes);
      const auto messages = messages_of(reader);
      // Times and sequence numbers of the record's head are not summed: then nothing is lost.
      ASSERT_GE(messages + 1, log.messages) << at << " " << flip;
      if (messages < log.messages) {
        const auto& findings = reader.findings();
        ASSERT_GT(findings.bad_crc + findings.damaged_bytes + findings.tail_bytes, 0U) << at << " " << flip;
      }
    }
  }
}

TEST(LogReader, GarbageInTheMiddleIsPassedOver) {
  const auto log = sample_log(1, true);
  std::string bytes = log.bytes;
  const auto at = log.ends[10];
  std::string garbage;
  for (unsigned i = 0; i < 70'000; ++i) garbage += static_cast<char>(i * i % 251);
  bytes.insert(at, garbage);
  LogReader reader = log_reader_of(bytes);
  EXPECT_EQ(messages_of(reader), log.messages);
  EXPECT_EQ(reader.findings().damaged_bytes, garbage.size());
  ASSERT_EQ(reader.findings().stretches.size(), 1U);
  EXPECT_EQ(reader.findings().stretches[0].offset, at);
}

TEST(LogReader, AnAbsurdLengthTakesNoMemoryAndLosesNothingElse) {
  const auto log = sample_log(1, true);
  std::string bytes = log.bytes;
  for (std::size_t i = 0; i < 8; ++i) bytes[log.ends[4] + 1 + i] = '\x7F';
  LogReader reader = log_reader_of(bytes);
  EXPECT_EQ(messages_of(reader), log.messages - 1);
}

TEST(LogReader, RefusesWhatIsNotALog) {
  EXPECT_THROW(log_reader_of(""), BadRecording);
  EXPECT_THROW(log_reader_of("#capture 1\n"), BadRecording);
  EXPECT_THROW(log_reader_of(kMcapMagic), BadRecording);
  std::string other(kMcapMagic);
  {
    const RecordScope header(other, Opcode::header);
    append_mcap_string(other, "ros2");
    append_mcap_string(other, "");
  }
  try {
    log_reader_of(other);
    FAIL();
  } catch (const BadRecording& error) {
    EXPECT_STREQ(error.what(),
                 "test.mcap: byte 8: an MCAP file, but not a log of navcal (its profile is \"ros2\"); "
                 "\"navcal log import\" reads bags of ROS 2");
  }
}

TEST(LogReader, ASummaryThatDoesNotMatchItsSumIsNoEnd) {
  const auto log = sample_log(1, true);
  std::string bytes = log.bytes;
  bytes[log.data_end + 60] = static_cast<char>(bytes[log.data_end + 60] ^ 1);
  LogReader reader = log_reader_of(bytes);
  EXPECT_EQ(messages_of(reader), log.messages);
  EXPECT_FALSE(reader.findings().finished);
}

}  // namespace
}  // namespace navcal::record
