// SPDX-License-Identifier: Apache-2.0
#include "record/seen_recordings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/support/temporary_folder.h"

namespace navcal::record {
namespace {

class SeenRecordingsTest : public ::testing::Test {
 protected:
  /// 500 bytes a second from the stream of this seed, in reads of `chunk` bytes; `noise` false: always the same.
  std::filesystem::path made(const std::string& name, unsigned seed, int from_s, int until_s,
                             std::size_t chunk = 50, bool noise = true) {
    std::mt19937 random(seed);
    std::vector<unsigned> bytes;
    for (int i = 0; i < 500 * until_s; ++i) {
      const unsigned byte = random() & 255U;
      bytes.push_back(noise ? byte : static_cast<unsigned>(i % 50));
    }
    std::ofstream out(folder_ / name);
    out << "#capture 1\n#port " << name.substr(0, 1) << " imu-card 57600\n#port outputs described 115200\n";
    for (std::size_t i = 500U * static_cast<std::size_t>(from_s); i + chunk <= bytes.size(); i += chunk) {
      out << fmt::format("{:.9f} {} < ", 1.9e9 + seed + static_cast<double>(i) / 500, name.substr(0, 1));
      for (std::size_t k = i; k < i + chunk; ++k) out << fmt::format("{:02x}", bytes[k]);
      out << '\n';
    }
    return folder_ / name;
  }
  navcal::test::TemporaryFolder folder_;
  SeenRecordings seen_;
};

TEST_F(SeenRecordingsTest, ARecordingIsKnownAgainWhateverItsReadsAndPorts) {
  EXPECT_FALSE(seen_.see(made("a", 1, 0, 60)));
  const auto again = seen_.see(made("b", 1, 0, 60, 125));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->of.filename(), "a");
  EXPECT_TRUE(again->is_whole);
  EXPECT_NEAR(again->shared_s, 60, 1);
}

TEST_F(SeenRecordingsTest, TheSameOrdersMakeNoSameRecording) {
  for (const unsigned seed : {1U, 2U}) {
    const auto file = made(seed == 1 ? "a" : "b", seed, 0, 30);
    std::ofstream out(file, std::ios::app);
    for (int i = 0; i < 300; ++i) {
      out << fmt::format("{:.9f} outputs < ", 1.9e9 + seed + 30 + 0.1 * i);
      for (const char one : fmt::format("$PNCAO,{},{},1500,1500,,,,*00\r\n", 1500 + i, 1900 - i))
        out << fmt::format("{:02x}", static_cast<unsigned>(one));
      out << '\n';
    }
    out.close();
    EXPECT_FALSE(seen_.see(file)) << seed;
  }
}

TEST_F(SeenRecordingsTest, PartsAndOverlapsAreTold) {
  EXPECT_FALSE(seen_.see(made("a", 1, 0, 60)));
  const auto part = seen_.see(made("b", 1, 20, 30));
  ASSERT_TRUE(part);
  EXPECT_TRUE(part->is_whole) << "all of the shorter one";
  EXPECT_NEAR(part->shared_s, 10, 1.5);
  std::vector<std::string> remarks;
  EXPECT_TRUE(seen_.is_new(made("c", 1, 45, 105), remarks)) << "45 s of it are new";
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_NE(remarks[0].find("s of it are in"), std::string::npos);
  EXPECT_NE(remarks[0].find("count twice"), std::string::npos);
  EXPECT_FALSE(seen_.is_new(made("d", 1, 0, 60), remarks));
  EXPECT_NE(remarks.back().find("a recording counts once"), std::string::npos);
}

TEST_F(SeenRecordingsTest, OtherReadingsAndThoseThatNeverChangeAreNoRepetition) {
  EXPECT_FALSE(seen_.see(made("a", 1, 0, 60)));
  EXPECT_FALSE(seen_.see(made("b", 2, 0, 60)));
  EXPECT_FALSE(seen_.see(made("c", 3, 0, 60, 50, false)));
  EXPECT_FALSE(seen_.see(made("d", 4, 0, 60, 50, false)));
}

}  // namespace
}  // namespace navcal::record
