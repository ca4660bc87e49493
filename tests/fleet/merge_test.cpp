// SPDX-License-Identifier: Apache-2.0
#include "fleet/merge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/database.h"
#include "fleet/plan_report.h"
#include "fleet/worker_pool.h"
#include "tests/fleet/fleet_folder.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGapAnswer =
    R"({"verdict":"explained","sentence":"It's it.","where":[{"channel":"compass.field","regime":"constant","gap":2.5,)"
    R"("unit":"uT","floor":0.5,"p_value":1e-9}],"effects":[{"name":"hard_iron","probability":0.99,)"
    R"("parameters":{"x_uT":1.5,"y_uT":null},"std_errors":{"x_uT":0.1,"y_uT":null}}],"candidates":[],)"
    R"("gap":{"before":3,"after":1,"floor":1,"closed":1,"closed_ci":[0.9,1.1],"heading_error_rad":null},)"
    R"("duration_s":600})";

class Merge : public testing::Test {
 protected:
  Merge() {
    for (int i = 0; i < 6; ++i) folder_.add_recording(std::to_string(i) + ".cap", i);
    folder_.add_file("poison.cap", "poison");
    (void)folder_.make({"gap", "calibrate"});
    plan_ = load_plan(folder_.plan());
  }
  [[nodiscard]] std::string merged(const std::string& name, MergeSummary* summary = nullptr) const {
    const MergeSummary made = merge(plan_, folder_ / name);
    if (summary != nullptr) *summary = made;
    return navcal::test::read_file(folder_ / name);
  }
  [[nodiscard]] std::vector<const Task*> tasks(std::string_view job) const {
    std::vector<const Task*> found;
    for (const Task& task : plan_.tasks) {
      if (task.job == job) found.push_back(&task);
    }
    return found;
  }
  test::FleetFolder folder_;
  Plan plan_;
};

TEST_F(Merge, GivesTheSameBytesWhateverTheOrderOfWork) {
  const auto calibrations = tasks("calibrate");
  for (const Task* task : calibrations) (void)run_task(plan_, *task, 1);
  const std::string once = merged("once.sqlite");
  EXPECT_EQ(merged("twice.sqlite"), once);
  fs::remove_all(plan_.folder / "results");
  EXPECT_NE(merged("none.sqlite"), once);
  for (auto at = calibrations.rbegin(); at != calibrations.rend(); ++at) (void)run_task(plan_, **at, 2);
  EXPECT_EQ(merged("backwards.sqlite"), once);
}

TEST_F(Merge, HasAnswersErrorsAndWhatIsOpen) {
  const ResultStore results(plan_.folder);
  results.keep_answer(*tasks("gap")[0], kGapAnswer);
  for (const Task* task : tasks("calibrate")) (void)run_task(plan_, *task, 1);
  MergeSummary summary;
  (void)merged("all.sqlite", &summary);
  EXPECT_EQ(summary.done, 7U);
  EXPECT_EQ(summary.failed, 1U);
  EXPECT_EQ(summary.open, 6U);
  Database database(folder_ / "all.sqlite", Database::Access::read);
  Statement rows(
      database,
      "SELECT verdict, effect, parameter, value, closed_low FROM gap JOIN gap_parameters USING(task) WHERE "
      "value IS NOT NULL");
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.text(0), "explained");
  EXPECT_EQ(rows.text(1), "hard_iron");
  EXPECT_EQ(rows.text(2), "x_uT");
  EXPECT_EQ(rows.text(3), "1.5");
  EXPECT_EQ(rows.text(4), "0.9");
  EXPECT_FALSE(rows.step());
  Statement errors(database,
                   "SELECT path, error FROM tasks JOIN recordings USING(recording) WHERE state='failed'");
  ASSERT_TRUE(errors.step());
  EXPECT_NE(errors.text(0).find("poison.cap"), std::string::npos);
  EXPECT_NE(errors.text(1).find("neither a capture"), std::string::npos);
  Statement calibrators(database, "SELECT count(*) FROM calibrators");
  ASSERT_TRUE(calibrators.step());
  EXPECT_GT(calibrators.integer(0), 0);
}

TEST_F(Merge, TheCataloguesAreWholeBySQLitesOwnCheck) {
  (void)merged("all.sqlite");
  for (const fs::path& file : {fs::path(folder_ / "all.sqlite"), catalogue_of(plan_.folder)}) {
    Database database(file, Database::Access::read);
    Statement check(database, "PRAGMA integrity_check");
    ASSERT_TRUE(check.step());
    EXPECT_EQ(check.text(0), "ok");
  }
}

TEST_F(Merge, PageAndListShowStatesAndErrors) {
  const ResultStore results(plan_.folder);
  results.keep_answer(*tasks("gap")[0], kGapAnswer);
  for (const Task* task : tasks("calibrate")) (void)run_task(plan_, *task, 1);
  const std::string page = merge_page(plan_, results), list = list_text(plan_, results),
                    json = list_json(plan_, results);
  for (const char* text : {"hard_iron", "explained", "100 %", "neither a capture", "poison.cap"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  EXPECT_NE(list.find("failed"), std::string::npos);
  EXPECT_NE(list.find("neither a capture"), std::string::npos);
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 14);
  EXPECT_NE(json.find(R"("state":"open")"), std::string::npos);
}

TEST_F(Merge, AResultThatIsNoJsonIsAnErrorThatNamesItsTask) {
  ResultStore(plan_.folder).keep_answer(*tasks("gap")[0], "{");
  EXPECT_THROW((void)merged("all.sqlite"), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_ / "all.sqlite"));
}

}  // namespace
}  // namespace navcal::fleet
