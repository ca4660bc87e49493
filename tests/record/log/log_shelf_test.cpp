// SPDX-License-Identifier: Apache-2.0
// Logs as somebody sees them who downloads them.
#include "record/log/log_shelf.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "record/log/checksum.h"
#include "record/log/mcap_format.h"
#include "tests/record/sample_log.h"
#include "tests/support/temporary_folder.h"

namespace navcal::record {
namespace {

class LogShelf : public ::testing::Test {
 protected:
  void put(const std::string& name, std::string_view bytes, mode_t mode = 0444) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    ASSERT_EQ(::chmod((folder_ / name).c_str(), mode), 0);
  }
  [[nodiscard]] std::vector<std::string> names(std::string_view after, std::size_t limit = 100) const {
    std::vector<std::string> found;
    for (const auto& log : list_logs(folder_.path(), after, limit).logs) found.push_back(log.name);
    return found;
  }
  [[nodiscard]] std::optional<LogSpan> span(std::string_view bytes) const {
    const std::string name = log_name(0, 1);
    ::unlink((folder_ / name).c_str());
    put(name, bytes);
    return list_logs(folder_.path(), "", 1).logs.at(0).span;
  }

  navcal::test::TemporaryFolder folder_;
};

TEST(LogNames, AreThoseThatLogNameMakesAndNoOthers) {
  EXPECT_TRUE(is_log_name(log_name(1'795'228'200'000'000'000, 123)));
  EXPECT_TRUE(is_log_name(log_name(0, 12345678)));
  const std::string good = log_name(0, 1);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char c : {'/', '.', '\0', ' ', 'x', '\n'}) {
      std::string bad = good;
      if (bad[i] == c) continue;
      bad[i] = c;
      EXPECT_FALSE(is_log_name(bad)) << bad;
    }
    EXPECT_FALSE(is_log_name(good.substr(0, i)));
    EXPECT_FALSE(is_log_name(good.substr(i + 1)));
  }
  EXPECT_FALSE(is_log_name("navcal-../../../etc/pas-000001.mcap"));
  EXPECT_FALSE(is_log_name(good + "/"));
}

TEST_F(LogShelf, LogsAreListedByCounterPageByPageAndNothingElseIs) {
  const std::string old = log_name(9'000'000'000, 999'999), later = log_name(5'000'000'000, 1'000'000),
                    first = log_name(7'000'000'000, 2);
  for (const std::string& name : {later, first, old}) put(name, "x");
  put("navcal.lock", "");
  put("navcal-x.mcap", "");
  std::filesystem::create_symlink("/etc/passwd", folder_ / log_name(0, 3));
  std::filesystem::create_directory(folder_ / log_name(0, 4));
  EXPECT_EQ(names(""), (std::vector<std::string>{first, old, later}));
  EXPECT_EQ(names("", 2), (std::vector<std::string>{first, old}));
  EXPECT_TRUE(list_logs(folder_.path(), "", 2).more);
  EXPECT_EQ(names(old), std::vector<std::string>{later});
  EXPECT_FALSE(list_logs(folder_.path(), old, 1).more);
  // One that is gone still has its place in the order.
  EXPECT_EQ(names(log_name(0, 5)), (std::vector<std::string>{old, later}));
  EXPECT_TRUE(list_logs(folder_ / "nowhere", "", 1).error);
}

TEST_F(LogShelf, AFinishedLogHasItsTimesAndADamagedOneHasNone) {
  const auto log = testing::sample_log(3, true);
  const auto whole = span(log.bytes);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->begin_ns, testing::kSampleStart_ns + testing::kSampleOffset_ns);
  EXPECT_NEAR(static_cast<double>(whole->end_ns - whole->begin_ns) * 1e-9, 3, 0.2);
  EXPECT_FALSE(span(testing::sample_log(3, false).bytes));
  EXPECT_FALSE(span(""));
  // Whatever byte of the summary is wrong: no crash, and times or none.
  for (std::size_t at = log.data_end; at < log.bytes.size(); ++at) {
    std::string bytes = log.bytes;
    bytes[at] = static_cast<char>(bytes[at] ^ 0xff);
    static_cast<void>(span(bytes));
    static_cast<void>(span(std::string_view(log.bytes).substr(0, at)));
  }
  put(log_name(0, 2), log.bytes, 0644);
  EXPECT_FALSE(list_logs(folder_.path(), log_name(0, 1), 1).logs.at(0).span) << "it is being written";
}

TEST_F(LogShelf, APartIsThoseBytesAndTheirSum) {
  std::string bytes(200'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 / 7);
  const std::string name = log_name(0, 7);
  put(name, bytes);
  for (const std::uint64_t offset : {0U, 1U, 65535U, 134'464U, 199'999U, 200'000U}) {
    for (const std::uint64_t length : {1U, 1000U, 65536U, 70'000U}) {
      const auto part = std::get<LogPart>(read_log(folder_.path(), name, offset, length));
      EXPECT_EQ(part.bytes, bytes.substr(offset, std::min(length, kMaxPart_bytes)));
      EXPECT_EQ(part.length, part.bytes.size());
      EXPECT_EQ(part.crc32, crc32(part.bytes));
      EXPECT_EQ(part.size, bytes.size());
      const auto sum = std::get<LogPart>(sum_log(folder_.path(), name, offset, length));
      EXPECT_EQ(sum.crc32, crc32(std::string_view(bytes).substr(offset, length)));
      EXPECT_TRUE(sum.bytes.empty());
    }
  }
  EXPECT_TRUE(std::holds_alternative<std::string>(read_log(folder_.path(), name, 200'001, 1)));
  EXPECT_TRUE(std::holds_alternative<std::string>(read_log(folder_.path(), name, UINT64_MAX, 1)));
}

TEST_F(LogShelf, OnlyRegularFilesAreRead) {
  const std::string link = log_name(0, 1), folder = log_name(0, 2), pipe = log_name(0, 3);
  std::filesystem::create_symlink("/etc/passwd", folder_ / link);
  std::filesystem::create_directory(folder_ / folder);
  ASSERT_EQ(::mkfifo((folder_ / pipe).c_str(), 0600), 0);
  for (const std::string& name : {link, folder, pipe, std::string("../passwd"), log_name(0, 4)})
    EXPECT_TRUE(std::holds_alternative<std::string>(read_log(folder_.path(), name, 0, 1))) << name;
}

/// A file whose summary is these records, and whose footer says that it begins at `begin`.
std::string file_ending_with(std::string_view head, std::string_view summary, std::uint64_t begin) {
  std::string bytes = std::string(head) + std::string(summary);
  bytes += static_cast<char>(Opcode::footer);
  append_le(bytes, std::uint64_t{kFooterLength});
  append_le(bytes, begin);
  append_le(bytes, std::uint64_t{0});
  append_le(bytes, std::uint32_t{0});
  return bytes + std::string(kMcapMagic);
}

TEST_F(LogShelf, TheTimesOfALogOfAnotherWriterAreReadAndAFileWithoutSummaryHasNone) {
  std::string statistics;
  {
    const RecordScope record(statistics, Opcode::statistics);
    append_le(statistics, std::uint64_t{5});
    append_le(statistics, std::uint16_t{0});
    for (int i = 0; i < 4; ++i) append_le(statistics, std::uint32_t{0});
    append_le(statistics, std::int64_t{1000});
    append_le(statistics, std::int64_t{3000});
    append_le(statistics, std::uint32_t{0});
  }
  const std::string head(kMcapMagic);
  const auto alone = span(file_ending_with(head, statistics, head.size()));
  ASSERT_TRUE(alone) << "the last record of a summary ends where the summary does";
  EXPECT_EQ(alone->begin_ns, 1000);
  EXPECT_EQ(alone->end_ns, 3000);
  EXPECT_FALSE(span(file_ending_with("", statistics, 0))) << "0: there is no summary";
  EXPECT_FALSE(span(file_ending_with(head, statistics, head.size() + statistics.size() + 1)));
  EXPECT_FALSE(span(file_ending_with(head, statistics, UINT64_MAX)));
  EXPECT_FALSE(span(file_ending_with(head, statistics.substr(0, statistics.size() - 1), head.size())))
      << "a record that is longer than the summary";
}

TEST_F(LogShelf, WhyALogIsNotReadIsSaid) {
  const auto why = [&](const std::string& name) {
    return std::get<std::string>(read_log(folder_.path(), name, 0, 1));
  };
  EXPECT_EQ(why("../passwd"), "that is not the name of a log; log.list has them");
  EXPECT_EQ(why(log_name(0, 4)),
            log_name(0, 4) + ": there is no such log (any more: the oldest are removed to make room)");
  std::filesystem::create_directory(folder_ / log_name(0, 2));
  EXPECT_EQ(why(log_name(0, 2)), log_name(0, 2) + ": not a regular file");
  put(log_name(0, 3), "abc");
  EXPECT_EQ(std::get<std::string>(read_log(folder_.path(), log_name(0, 3), 4, 1)),
            log_name(0, 3) + ": byte 4 is behind its end at 3");
}

}  // namespace
}  // namespace navcal::record
