// SPDX-License-Identifier: Apache-2.0
// What other readers of MCAP find in a log beside its messages.
#include <gtest/gtest.h>

#include "record/log/log_reader.h"
#include "record/log/mcap_fields.h"
#include "tests/record/memory_source.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

/// The content of the first record of a kind from `offset` on; empty if there is none.
std::string_view first_record(std::string_view bytes, std::size_t offset, Opcode opcode) {
  while (offset + kRecordHead <= bytes.size()) {
    const auto length = read_le<std::uint64_t>(bytes, offset + 1);
    if (bytes[offset] == static_cast<char>(opcode)) return bytes.substr(offset + kRecordHead, length);
    offset += kRecordHead + length;
  }
  return {};
}

TEST(Mcap, TheHeaderNamesProfileAndLibrary) {
  const auto log = testing::sample_log(1, true);
  McapFields header(first_record(log.bytes, kMcapMagic.size(), Opcode::header));
  EXPECT_EQ(header.string(), "navcal");
  EXPECT_EQ(header.string(), "navcal");
  EXPECT_TRUE(header.complete() && header.at_end());
}

TEST(Mcap, TheStatisticsCountTheMessagesOfEveryChannel) {
  const auto log = testing::sample_log(2, true);
  LogReader reader(std::make_unique<MemorySource>(log.bytes), "x");
  std::map<std::uint16_t, std::uint64_t> expected;
  while (const auto message = reader.next()) ++expected[message->channel];
  for (const auto& [id, channel] : reader.channels()) expected.try_emplace(id, 0);
  McapFields statistics(first_record(log.bytes, log.data_end, Opcode::statistics));
  EXPECT_EQ(statistics.integer<std::uint64_t>(), log.messages);
  EXPECT_EQ(statistics.integer<std::uint16_t>(), json_topics().size());
  EXPECT_EQ(statistics.integer<std::uint32_t>(), expected.size());
  EXPECT_EQ(statistics.integer<std::uint32_t>(), 0U) << "attachments";
  EXPECT_EQ(statistics.integer<std::uint32_t>(), 1U) << "metadata";
  EXPECT_EQ(statistics.integer<std::uint32_t>(), 0U) << "chunks";
  EXPECT_EQ(statistics.integer<std::int64_t>(), testing::kSampleStart_ns + testing::kSampleOffset_ns);
  statistics.integer<std::int64_t>();  // the end
  const std::string counts(statistics.string());
  McapFields each(counts);
  std::map<std::uint16_t, std::uint64_t> counted;
  while (!each.at_end()) {
    const auto id = each.integer<std::uint16_t>();
    counted[id] = each.integer<std::uint64_t>();
  }
  EXPECT_EQ(counted, expected);
  EXPECT_TRUE(statistics.complete() && statistics.at_end());
}

TEST(Mcap, ARawChannelTellsWhichDeviceItIs) {
  auto settings = testing::sample_settings();
  settings.ports[0].serial_number = "A1234";
  LogEncoder encoder(settings, "");
  std::string log;
  encoder.begin(log, testing::kSampleStart_ns, {});
  LogReader reader(std::make_unique<MemorySource>(log), "x");
  while (reader.next()) {
  }
  const auto metadata_of = [&](std::string_view topic) {
    for (const auto& [id, channel] : reader.channels()) {
      if (channel.topic == topic) return channel.metadata;
    }
    return std::map<std::string, std::string, std::less<>>{};
  };
  const std::string prefix(topic::kRawPrefix);
  EXPECT_EQ(metadata_of(prefix + "compass"),
            (std::map<std::string, std::string, std::less<>>{
                {"baud", "38400"}, {"protocol", "tcm2"}, {"serial_number", "A1234"}}));
  EXPECT_EQ(metadata_of(prefix + "imu"),
            (std::map<std::string, std::string, std::less<>>{{"baud", "57600"}, {"protocol", "imu-card"}}));
}

TEST(Mcap, DefinitionsWithoutEndTakeNoMoreThanTheirShareOfMemory) {
  const auto log = testing::sample_log(1, true);
  std::string schemas;
  constexpr std::size_t kEach = 1 << 20;
  for (std::uint16_t i = 0; i < 24; ++i)
    append_schema(schemas, static_cast<std::uint16_t>(1000 + i), "x", "jsonschema", std::string(kEach, 'x'));
  std::string bytes = log.bytes;
  bytes.insert(log.ends[0], schemas);
  LogReader reader(std::make_unique<MemorySource>(bytes), "x");
  std::uint64_t messages = 0;
  while (reader.next()) ++messages;
  EXPECT_EQ(messages, log.messages);
  EXPECT_GT(reader.findings().damaged_bytes, 7U * kEach);
  EXPECT_LT(reader.findings().damaged_bytes, 11U * kEach);
}

}  // namespace
}  // namespace navcal::record
