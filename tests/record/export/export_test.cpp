// SPDX-License-Identifier: Apache-2.0
#include "record/export/export.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "record/log/log_info.h"
#include "record/recording.h"
#include "tests/record/sample_log.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

using Export = testing::TemporaryFolder;

void no_progress(double) {}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST_F(Export, CsvHasOneFileForEachTopic) {
  const auto log = testing::sample_log(2, true);
  const auto exported = export_csv(write("a.mcap", log.bytes), path_ / "csv", no_progress);
  EXPECT_TRUE(exported.remarks.empty());
  const auto imu = read(path_ / "csv" / "imu.csv");
  EXPECT_EQ(lines(imu), 41U);
  EXPECT_EQ(imu.substr(0, imu.find('\n')),
            "time_s,time_std_s,arrival_s,device,rate_rad_s_x,rate_rad_s_y,rate_rad_s_z,yaw_rate_b_rad_s,"
            "yaw_rate_calibrated_rad_s,yaw_rate_b_calibrated_rad_s,"
            "specific_force_m_s2_x,specific_force_m_s2_y,specific_force_m_s2_z,depth_m,sequence,leak_forward,"
            "leak_aft,low_supply,over_range,temperature_C,rate_std_rad_s,specific_force_std_m_s2,depth_std_m,"
            "calibration");
  const auto compass = read(path_ / "csv" / "compass.csv");
  EXPECT_NE(
      compass.find("\n1790000004.950000008,0.001500000,1790000005.000000008,compass,5.7334,,false,0.1,,55.11,"),
      std::string::npos)
      << compass.substr(0, 600);
  EXPECT_EQ(lines(read(path_ / "csv" / "raw_compass.csv")), 21U);
  EXPECT_NE(read(path_ / "csv" / "config.toml").find("[port.imu]"), std::string::npos);
  EXPECT_EQ(lines(read(path_ / "csv" / "health.csv")), 3U);
  for (const auto& entry : std::filesystem::directory_iterator(path_ / "csv")) {
    EXPECT_NE(entry.path().extension(), ".part");
  }
}

TEST_F(Export, ACaptureOfALogHasTheSameBytesInTheSameOrder) {
  const auto log = testing::sample_log(2, true);
  const auto file = write("a.mcap", log.bytes);
  const auto exported = export_capture(file, path_ / "a.cap", no_progress);
  EXPECT_TRUE(exported.remarks.empty());
  EXPECT_EQ(exported.files, std::vector{path_ / "a.cap"});
  const auto from = Recording::open(file);
  const auto to = Recording::open(path_ / "a.cap");
  const auto next_read = [](Recording& recording) -> std::optional<RawRead> {
    while (auto entry = recording.next()) {
      if (auto* read = std::get_if<RawRead>(&*entry)) return std::move(*read);
    }
    return std::nullopt;
  };
  std::uint64_t reads = 0;
  while (const auto a = next_read(*from)) {
    const auto b = next_read(*to);
    ASSERT_TRUE(b);
    EXPECT_EQ(a->bytes, b->bytes);
    EXPECT_EQ(a->port, b->port);
    EXPECT_EQ(a->time_ns + testing::kSampleOffset_ns, b->time_ns);
    ++reads;
  }
  EXPECT_EQ(reads, log.raw_messages);
}

TEST_F(Export, AnInterruptedExportLeavesNothing) {
  const auto file = write("a.mcap", testing::sample_log(60, true).bytes);
  const auto interrupt = [](double) { throw std::runtime_error("interrupted"); };
  EXPECT_THROW(export_capture(file, path_ / "a.cap", interrupt), std::runtime_error);
  EXPECT_THROW(export_csv(file, path_ / "csv", interrupt), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(path_ / "a.cap"));
  EXPECT_FALSE(std::filesystem::exists(path_ / "a.cap.part"));
  EXPECT_TRUE(std::filesystem::is_empty(path_ / "csv"));
}

TEST_F(Export, AFolderThatCannotBeMadeIsNamed) {
  const auto file = write("a.mcap", testing::sample_log(1, true).bytes);
  EXPECT_THROW(export_capture(file, path_ / "absent" / "a.cap", no_progress), std::system_error);
  EXPECT_THROW(export_csv(file, file / "csv", no_progress), std::system_error);
}

TEST_F(Export, InfoCountsWhatIsThere) {
  auto log = testing::sample_log(3, false);
  log.bytes[log.ends[9] - 3] = static_cast<char>(log.bytes[log.ends[9] - 3] ^ 1);
  const auto info = read_info(write("a.mcap", log.bytes + "torn"), no_progress);
  EXPECT_FALSE(info.finished);
  EXPECT_EQ(info.tail_bytes, 4U);
  EXPECT_EQ(info.bad_crc, 1U);
  ASSERT_EQ(info.ports.size(), 2U);
  std::uint64_t messages = 0;
  for (const auto& [topic, count] : info.topics) messages += count.messages;
  EXPECT_EQ(messages, log.messages - 1);
  EXPECT_EQ(info.events.size(), 3U);
  EXPECT_EQ(info.events[0].port, "imu");
  EXPECT_NEAR(static_cast<double>(info.end_utc_ns - info.start_utc_ns) * 1e-9, 2.95, 0.06);
  EXPECT_NE(to_text(info).find("unfinished"), std::string::npos);
  EXPECT_NE(to_json(info).find("\"bad_crc\":1"), std::string::npos);
}

}  // namespace
}  // namespace navcal::record
