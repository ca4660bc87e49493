// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_utc.h"

#include <gtest/gtest.h>

#include "config/load.h"
#include "record/log/log_info.h"
#include "tests/record/sample_log.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

using pipeline::UtcMapping;

class LogUtcOfFile : public testing::TemporaryFolder {
 protected:
  using enum UtcMapping::Source;

  /// A log of two reads, 1.5 s apart, whose clock was told by these mappings in turn.
  std::filesystem::path log_with(const std::vector<UtcMapping>& mappings) const {
    const auto settings = testing::sample_settings();
    LogEncoder encoder(settings, config::to_toml(settings));
    std::string log;
    const std::int64_t begin_ns = testing::kSampleStart_ns;
    encoder.begin(log, begin_ns, mappings.at(0));
    encoder.raw(log, 1, Direction::received, begin_ns, std::vector<std::uint8_t>(22));
    for (std::size_t i = 1; i < mappings.size(); ++i) encoder.mapping(log, begin_ns + 7, mappings[i]);
    encoder.raw(log, 1, Direction::received, begin_ns + 1'500'000'000, std::vector<std::uint8_t>(22));
    encoder.finish(log, begin_ns);
    return write("a.mcap", log);
  }
  [[nodiscard]] bool is_known(const UtcMapping& mapping) const {
    const LogUtc utc(log_with({mapping}));
    return utc.in_place_of({}).source != none;
  }
  static constexpr std::int64_t kFortySeconds_ns = 40'000'000'000;
};

TEST_F(LogUtcOfFile, AComputerWhoseClockWasNeverSetDoesNotKnowUtc) {
  EXPECT_FALSE(is_known({none, 0, UtcMapping::kUnknownBound, 0}));
  for (const auto source : {system, system_synchronised}) {
    EXPECT_FALSE(is_known({source, kFortySeconds_ns, UtcMapping::kUnknownBound, 0})) << name_of(source);
    EXPECT_FALSE(is_known({source, kFortySeconds_ns, 1'000'000, 0})) << name_of(source);
    EXPECT_TRUE(is_known({source, testing::kSampleOffset_ns, UtcMapping::kUnknownBound, 0})) << name_of(source);
  }
  // Others say the time themselves, of whatever year.
  EXPECT_TRUE(is_known({file, 0, 0, 0}));
  EXPECT_TRUE(is_known({gps, kFortySeconds_ns, 1'000'000, 0}));
}

TEST_F(LogUtcOfFile, TheBestMappingHoldsForWhatWasLoggedBeforeIt) {
  const UtcMapping unset{system, kFortySeconds_ns, UtcMapping::kUnknownBound, 0};
  const UtcMapping set{system, testing::kSampleOffset_ns + 3, UtcMapping::kUnknownBound, 0};
  const UtcMapping bounded{gps, testing::kSampleOffset_ns, 20'000'000, 0};
  EXPECT_EQ(LogUtc(log_with({unset, set})).in_place_of(unset).offset_ns, set.offset_ns);
  EXPECT_EQ(LogUtc(log_with({unset, set, bounded})).in_place_of(unset).offset_ns, bounded.offset_ns);
  EXPECT_EQ(LogUtc(log_with({set, bounded})).in_place_of(set).offset_ns, bounded.offset_ns);
  EXPECT_EQ(LogUtc(log_with({bounded, set})).in_place_of(unset).offset_ns, bounded.offset_ns);
}

TEST_F(LogUtcOfFile, TimesThatAreNotUtcAreToldAsSeconds) {
  const auto never = to_text(read_info(log_with({{none, 0, UtcMapping::kUnknownBound, 0}}), [](double) {}));
  EXPECT_NE(never.find("\nfrom 5.000 s (monotonic: UTC was not known)\n"
                       "to   6.500 s (monotonic: UTC was not known) (1.500 s)\n"),
            std::string::npos)
      << never;
  const auto known = to_text(read_info(log_with({{gps, testing::kSampleOffset_ns, 1, 0}}), [](double) {}));
  EXPECT_NE(known.find("\nfrom 2026-09-21T14:13:25"), std::string::npos) << known;
  EXPECT_EQ(known.find("monotonic"), std::string::npos) << known;
}

TEST(RecordingInfoText, SaysWhatKindOfFileItIs) {
  RecordingInfo info;
  info.file = "a";
  info.bytes = 12;
  EXPECT_TRUE(to_text(info).starts_with("a: capture, 12 bytes, finished\n")) << to_text(info);
  info.log = true;
  info.finished = false;
  EXPECT_TRUE(to_text(info).starts_with("a: log, 12 bytes, unfinished\n")) << to_text(info);
}

TEST(RecordingInfoJson, TextsOfPeopleStayReadableAndDamagedOnesAreText) {
  RecordingInfo info;
  info.file = "Tauchgang_Kühlungsborn.mcap";
  info.events.push_back({"1.5", "info", "mark", "", "broken \xff byte"});
  const std::string json = to_json(info);
  EXPECT_NE(json.find("Tauchgang_Kühlungsborn.mcap"), std::string::npos) << json;
  EXPECT_NE(json.find("broken \xEF\xBF\xBD byte"), std::string::npos) << json;
}

}  // namespace
}  // namespace navcal::record
