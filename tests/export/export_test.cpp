// SPDX-License-Identifier: Apache-2.0
// What the exports as one file do besides being right, which readers of others judge (check).
#include "record/export/export.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>

#include "record/export/field_meaning.h"
#include "record/export/topic_columns.h"
#include "record/export/topic_table.h"
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
      const auto* meaning = field_meaning(topic.name, field.name);
      ASSERT_NE(meaning, nullptr) << topic.name << ' ' << field.name;
      EXPECT_FALSE(meaning->long_name.empty()) << field.name;
      const bool has_unit = field.kind == FieldKind::number || field.kind == FieldKind::vector3;
      const bool is_date = field.name == "time" || field.name == "arrival";
      // The unit of a mission sensor stands in a column of its own.
      const bool has_own_unit = topic.id == topic::kSensor && field.name.starts_with("value");
      EXPECT_EQ(has_unit && !is_date && !has_own_unit, !meaning->units.empty()) << field.name;
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

}  // namespace
}  // namespace navcal::record
