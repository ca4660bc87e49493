// SPDX-License-Identifier: Apache-2.0
// What the exports as one file do besides being right, which readers of others judge (check).
#include "record/export/export.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <matio.h>
#include <netcdf.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <string>
#include <vector>

#include "record/export/log_tables.h"
#include "record/export/topic_columns.h"
#include "record/export/topic_table.h"
#include "record/log/mcap_format.h"
#include "tests/record/sample_log.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

using Exporter = Exported (*)(const std::filesystem::path&, const std::filesystem::path&, const Progress&);

void no_progress(double) {}

class ExportFile : public testing::TemporaryFolder, public ::testing::WithParamInterface<Exporter> {
 protected:
  void expect_nothing_but(const std::filesystem::path& log) const {
    for (const auto& entry : std::filesystem::directory_iterator(path_)) EXPECT_EQ(entry.path(), log);
  }
};

TEST_P(ExportFile, AppearsUnderItsNameOnly) {
  const auto log = write("a.mcap", testing::sample_log(2, true).bytes);
  const auto exported = GetParam()(log, path_ / "a.out", no_progress);
  EXPECT_EQ(exported.files, std::vector{path_ / "a.out"});
  EXPECT_GT(std::filesystem::file_size(path_ / "a.out"), 1000U);
  EXPECT_FALSE(std::filesystem::exists(path_ / "a.out.part"));
}

TEST_P(ExportFile, TheSameLogGivesTheSameFile) {
  const auto log = write("a.mcap", testing::sample_log(2, true).bytes);
  GetParam()(log, path_ / "a.out", no_progress);
  GetParam()(log, path_ / "b.out", no_progress);
  EXPECT_EQ(read(path_ / "a.out"), read(path_ / "b.out"));
}

TEST_P(ExportFile, InterruptedWhileReadingOrWritingItLeavesNothing) {
  const auto log = write("a.mcap", testing::sample_log(60, true).bytes);
  int calls = 0;
  (void)GetParam()(log, path_ / "whole", [&calls](double) { ++calls; });
  std::filesystem::remove(path_ / "whole");
  ASSERT_GT(calls, 4);
  for (const int at : {1, calls / 2, calls}) {
    int call = 0;
    const auto interrupt = [&](double) {
      if (++call == at) throw std::runtime_error("interrupted");
    };
    EXPECT_THROW(GetParam()(log, path_ / "a.out", interrupt), std::runtime_error) << at;
    expect_nothing_but(log);
  }
}

TEST_P(ExportFile, AFullDiskIsToldAndLeavesNothing) {
  const auto log = write("a.mcap", testing::sample_log(60, true).bytes);
  GetParam()(log, path_ / "whole", no_progress);
  const auto whole = std::filesystem::file_size(path_ / "whole");
  std::filesystem::remove(path_ / "whole");
  // A limit on files behaves as a full disk does, without one.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const auto limit : {whole / 20, whole / 2, whole - 1}) {
    const rlimit little{limit, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    EXPECT_THROW(GetParam()(log, path_ / "a.out", no_progress), std::system_error) << limit << " of " << whole;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    expect_nothing_but(log);
  }
}

TEST_P(ExportFile, AFolderThatIsNotThereIsNamed) {
  const auto log = write("a.mcap", testing::sample_log(1, true).bytes);
  try {
    GetParam()(log, path_ / "absent" / "a.out", no_progress);
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("absent/a.out"), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Export, ExportFile, ::testing::Values(export_netcdf, export_mat, export_ros2),
                         [](const auto& form) {
                           return form.param == export_netcdf ? "Netcdf"
                                  : form.param == export_mat  ? "Mat"
                                                              : "Ros2";
                         });

TEST(TopicTable, EveryFieldOfEveryTopicHasItsMeaning) {
  for (const Topic& topic : json_topics()) {
    if (topic.id == topic::kConfig) continue;
    for (const Field& field : topic.fields) {
      EXPECT_FALSE(field.long_name.empty()) << topic.name << ' ' << field.name;
      const bool has_unit = field.kind == FieldKind::number || field.kind == FieldKind::vector3;
      const bool is_date = field.name == "time" || field.name == "arrival";
      // The unit of a mission sensor stands in a column of its own.
      const bool has_own_unit = topic.id == topic::kSensor && field.name.starts_with("value");
      EXPECT_EQ(has_unit && !is_date && !has_own_unit, !field.units.empty()) << field.name;
    }
  }
}

TEST(TopicTable, TimesAreExactAndWhatIsAbsentIsMarked) {
  TopicTable table("/imu");
  const std::string tail = R"(,"crc":"00000000"})";
  ASSERT_TRUE(table.append(R"({"time":1790000004.950000008,"time_std":0.0015,"leak_aft":true)" + tail, 7));
  ASSERT_TRUE(table.append(R"({"time":null,"depth_m":1e-3,"rate_rad_s":[1,null,3])" + tail, 7));
  EXPECT_FALSE(table.append("{", 7));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.times_ns(), (std::vector<std::int64_t>{1'790'000'004'950'000'008, 7}));
  EXPECT_FALSE(table.times_increase());
  for (const auto& column : table.columns()) {
    if (const auto* numbers = std::get_if<NumberColumn>(&column.values)) {
      ASSERT_EQ(numbers->rows.size(), 2U);
      if (column.head.title == "time_std_s") {
        EXPECT_EQ(numbers->rows[0], 0.0015);
      }
      if (column.head.title == "depth_m") {
        EXPECT_EQ(numbers->rows[1], 1e-3);
      }
      if (column.head.title == "rate_rad_s_y") {
        EXPECT_TRUE(std::isnan(numbers->rows[1]));
      }
    } else if (column.head.title == "leak_aft") {
      EXPECT_EQ(std::get<BooleanColumn>(column.values).rows,
                (std::vector<std::int8_t>{1, BooleanColumn::kAbsent}));
    } else if (column.head.title == "arrival_s") {
      EXPECT_EQ(std::get<NanosecondColumn>(column.values).rows[0], NanosecondColumn::kAbsent);
    }
  }
}

class ExportedContent : public testing::TemporaryFolder {
 protected:
  /// A log of three events and as many reads of the compass.
  std::filesystem::path log_of_three() const {
    const auto settings = testing::sample_settings();
    LogEncoder encoder(settings, "# configuration\n");
    std::string log;
    const std::int64_t begin_ns = testing::kSampleStart_ns;
    encoder.begin(log, begin_ns,
                  {pipeline::UtcMapping::Source::gps, testing::kSampleOffset_ns, 20'000'000, begin_ns});
    for (std::size_t i = 0; i < kMessages.size(); ++i) {
      const std::int64_t at_ns = begin_ns + static_cast<std::int64_t>(i) * 1'000'000'000;
      encoder.event(log, at_ns, "info", "mark", "", kMessages.at(i));
      encoder.sample(log, testing::compass_sample(at_ns));
    }
    encoder.finish(log, begin_ns);
    return write("three.mcap", log);
  }
  /// One of a single event, which is this text.
  std::filesystem::path log_of_one(const std::string& content) const {
    const auto settings = testing::sample_settings();
    LogEncoder encoder(settings, "");
    std::string log;
    encoder.begin(log, testing::kSampleStart_ns, {});
    encoder.put(log, {topic::kEvent, testing::kSampleStart_ns, testing::kSampleStart_ns},
                [&](std::string& out) { out += content; });
    encoder.raw(log, 1, Direction::received, testing::kSampleStart_ns, std::vector<std::uint8_t>(22));
    encoder.finish(log, testing::kSampleStart_ns);
    return write("one.mcap", log);
  }
  static constexpr std::array<const char*, 3> kMessages{"the first", "and \"another\"", "the last"};
};

TEST_F(ExportedContent, NetcdfHasTextsAndSecondsSinceTheMidnightBeforeTheLog) {
  export_netcdf(log_of_three(), path_ / "a.nc", no_progress);
  int file = 0, group = 0, variable = 0;
  ASSERT_EQ(nc_open((path_ / "a.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
  ASSERT_EQ(nc_inq_grp_ncid(file, "event", &group), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(group, "message", &variable), NC_NOERR);
  std::array<char*, kMessages.size()> texts{};
  ASSERT_EQ(nc_get_var_string(group, variable, texts.data()), NC_NOERR);
  for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_STREQ(texts.at(i), kMessages.at(i));
  nc_free_string(texts.size(), texts.data());
  ASSERT_EQ(nc_inq_varid(group, "time", &variable), NC_NOERR);
  std::string units(64, '\0');
  std::size_t length = 0;
  ASSERT_EQ(nc_inq_attlen(group, variable, "units", &length), NC_NOERR);
  ASSERT_LT(length, units.size());
  ASSERT_EQ(nc_get_att_text(group, variable, "units", units.data()), NC_NOERR);
  units.resize(length);
  EXPECT_EQ(units, "seconds since 2026-09-21 00:00:00");
  std::array<double, kMessages.size()> times{};
  ASSERT_EQ(nc_get_var_double(group, variable, times.data()), NC_NOERR);
  // 14:13:25 and the nanosecond of the mapping.
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(times.at(i), 51'205.000000001 + static_cast<double>(i), 1e-10);
  nc_close(file);
}

/// Text of a MAT-file's variable of characters.
std::string characters_of(const matvar_t* variable) {
  std::string text;
  if (variable == nullptr || variable->class_type != MAT_C_CHAR) return text;
  const auto width = static_cast<std::size_t>(variable->data_size);
  for (std::size_t at = 0; at < variable->nbytes; at += width)
    text += static_cast<const char*>(variable->data)[at];  // ASCII, the low byte first
  return text;
}

TEST_F(ExportedContent, AMatFileHasAStructureOfColumnsForEachTopic) {
  export_mat(log_of_three(), path_ / "a.mat", no_progress);
  mat_t* const file = Mat_Open((path_ / "a.mat").c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(file, nullptr);
  matvar_t* const event = Mat_VarRead(file, "event");
  ASSERT_NE(event, nullptr);
  const matvar_t* const messages = Mat_VarGetStructFieldByName(event, "message", 0);
  ASSERT_NE(messages, nullptr);
  ASSERT_EQ(messages->class_type, MAT_C_CELL);
  ASSERT_EQ(messages->dims[0], kMessages.size());
  for (std::size_t i = 0; i < kMessages.size(); ++i)
    EXPECT_EQ(characters_of(static_cast<matvar_t**>(messages->data)[i]), kMessages.at(i));
  Mat_VarFree(event);
  matvar_t* const compass = Mat_VarRead(file, "compass");
  ASSERT_NE(compass, nullptr);
  const matvar_t* const headings = Mat_VarGetStructFieldByName(compass, "heading_rad", 0);
  ASSERT_NE(headings, nullptr);
  ASSERT_EQ(headings->nbytes, kMessages.size() * sizeof(double));
  EXPECT_EQ(static_cast<const double*>(headings->data)[2], 5.7334);
  const matvar_t* const devices = Mat_VarGetStructFieldByName(compass, "device", 0);
  EXPECT_EQ(characters_of(devices), "cccooommmpppaaassssss") << "a matrix, column after column";
  Mat_VarFree(compass);
  Mat_Close(file);
}

TEST_F(ExportedContent, ATopicThatIsTooLongForAMatFileIsRefusedWithItsSize) {
  const auto settings = testing::sample_settings();
  LogEncoder encoder(settings, "");
  std::string log;
  encoder.begin(log, testing::kSampleStart_ns, {});
  // The longest text decides, and every row takes its room.
  encoder.event(log, testing::kSampleStart_ns, "info", "mark", "", std::string(1'000'000, 'x'));
  for (int i = 1; i < 1500; ++i) encoder.event(log, testing::kSampleStart_ns + i, "info", "mark", "", "x");
  encoder.finish(log, testing::kSampleStart_ns);
  try {
    export_mat(write("a.mcap", log), path_ / "a.mat", no_progress);
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::file_too_large);
    EXPECT_NE(std::string(error.what()).find("/event takes 3000 MB, and a variable of a MAT-file at most 2146 MB"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(path_ / "a.mat"));
}

TEST_F(ExportedContent, AMatFileIsMadeWithoutKeepingItsMemory) {
  const auto log = write("a.mcap", testing::sample_log(20, true).bytes);
  const auto used = [] { return mallinfo2().uordblks; };  // 0 under a sanitizer, which looks for leaks itself
  export_mat(log, path_ / "a.mat", no_progress);
  const std::size_t before = used();
  export_mat(log, path_ / "a.mat", no_progress);
  EXPECT_LT(used(), before + 16'384);
}

TEST_F(ExportedContent, ATopicWithoutAReadableMessageHasNoTable) {
  const auto tables = read_tables(log_of_one(R"({"class":"EVENT",this is no JSON})"), no_progress);
  for (const TopicTable& table : tables.tables) {
    EXPECT_NE(table.topic(), "/event");
    EXPECT_GT(table.rows(), 0U);
  }
  EXPECT_EQ(tables.remarks, std::vector<std::string>{"1 messages are not JSON: left out"});
  const auto whole = read_tables(log_of_one(R"({"class":"EVENT","time":1.5})"), no_progress);
  EXPECT_EQ(whole.tables.size(), tables.tables.size() + 1);
  EXPECT_TRUE(whole.remarks.empty());
}

TEST_F(ExportedContent, ABagSaysWhenItIsEmptyAndOnlyThen) {
  const std::string remark = "no message of the log has a type in ROS 2: an empty bag";
  const auto has_remark = [&](const std::filesystem::path& log) {
    const auto exported = export_ros2(log, path_ / "a.bag", no_progress);
    return std::ranges::find(exported.remarks, remark) != exported.remarks.end();
  };
  EXPECT_FALSE(has_remark(log_of_three()));
  EXPECT_TRUE(has_remark(log_of_one(R"({"class":"EVENT",this is no JSON})")));
}

TEST_F(ExportedContent, ABagComesInChunksThatAReaderCanHold) {
  export_ros2(write("a.mcap", testing::sample_log(200, true).bytes), path_ / "a.bag", no_progress);
  const std::string bag = read(path_ / "a.bag");
  std::vector<std::uint64_t> sizes;
  for (std::size_t at = kMcapMagic.size(); at + kRecordHead < bag.size();
       at += kRecordHead + read_le<std::uint64_t>(bag, at + 1)) {
    // Start, end, and the length without compression.
    if (bag[at] == static_cast<char>(Opcode::chunk))
      sizes.push_back(read_le<std::uint64_t>(bag, at + kRecordHead + 16));
  }
  ASSERT_GT(sizes.size(), 1U);
  for (const std::uint64_t size : sizes) EXPECT_LT(size, 2U << 20);
}

}  // namespace
}  // namespace navcal::record
