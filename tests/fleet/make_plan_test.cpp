// SPDX-License-Identifier: Apache-2.0
#include "fleet/make_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "base/failure.h"
#include "config/error.h"
#include "fleet/plan.h"
#include "fleet/result_store.h"
#include "tests/fleet/fleet_folder.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

class MakePlan : public testing::Test {
 protected:
  /// Keys of the tasks of the plan, by the paths of their recordings.
  [[nodiscard]] std::map<std::string, std::string> keys() const {
    std::map<std::string, std::string> found;
    const Plan plan = load_plan(folder_.plan());
    for (const Task& task : plan.tasks) {
      found[fs::relative(plan.recordings.at(task.recording).path, fs::canonical(folder_.recordings()))] = task.key;
    }
    return found;
  }
  test::FleetFolder folder_;
};

TEST_F(MakePlan, HasATaskForEachRecordingOfTheFolderAndThoseBelow) {
  folder_.add_recording("a.cap", 1);
  folder_.add_recording("deep/er/b.cap", 2);
  folder_.add_recording(".hidden/c.cap", 3);
  folder_.add_file("notes.txt", "no recording");
  const PlanSummary summary = folder_.make();
  EXPECT_EQ(summary.files, 2U);
  EXPECT_EQ(summary.tasks, 2U);
  EXPECT_EQ(summary.banks, 0U);
  const Plan plan = load_plan(folder_.plan());
  ASSERT_EQ(plan.tasks.size(), 2U);
  EXPECT_EQ(plan.tasks[0].number, 1);
  EXPECT_EQ(plan.tasks[0].job, "calibrate");
  EXPECT_EQ(plan.tasks[1].number, 2);
}

TEST_F(MakePlan, ARecordingThatMovedIsTheSameTaskAndIsReadOnlyOnce) {
  const fs::path a = folder_.add_recording("a.cap", 1);
  folder_.add_recording("b.cap", 2);
  EXPECT_EQ(folder_.make().read, 2U);
  const auto before = keys();
  fs::create_directory(folder_.recordings() / "moved");
  fs::rename(a, folder_.recordings() / "moved" / "z.cap");
  const PlanSummary summary = folder_.make();
  EXPECT_EQ(summary.read, 1U);
  EXPECT_EQ(summary.added, 0U);
  EXPECT_EQ(summary.gone, 1U);
  const auto after = keys();
  EXPECT_EQ(after.at("moved/z.cap"), before.at("a.cap"));
  EXPECT_EQ(after.at("b.cap"), before.at("b.cap"));
  EXPECT_EQ(folder_.make().read, 0U);
}

TEST_F(MakePlan, TwoCopiesAreOneTaskAndAChangedFileIsAnother) {
  folder_.add_recording("a.cap", 1);
  folder_.add_recording("copy.cap", 1);
  EXPECT_EQ(folder_.make().tasks, 1U);
  const std::string key = keys().at("a.cap");
  folder_.add_recording("a.cap", 2, 4);
  EXPECT_EQ(folder_.make().tasks, 2U);
  EXPECT_NE(keys().at("a.cap"), key);
  EXPECT_EQ(keys().at("copy.cap"), key);
}

TEST_F(MakePlan, ARecordingThatIsGoneHasNoTaskUntilItIsBack) {
  const fs::path a = folder_.add_recording("a.cap", 1);
  folder_.add_recording("b.cap", 2);
  (void)folder_.make();
  const auto before = keys();
  fs::rename(a, folder_ / "a.cap");
  EXPECT_EQ(folder_.make().tasks, 1U);
  fs::rename(folder_ / "a.cap", a);
  const PlanSummary summary = folder_.make();
  EXPECT_EQ(summary.tasks, 2U);
  EXPECT_EQ(summary.added, 0U);
  EXPECT_EQ(keys(), before);
}

TEST_F(MakePlan, KeepsTheNumbersOfTasksWhenOthersComeBeforeThem) {
  folder_.add_recording("m.cap", 1);
  (void)folder_.make();
  folder_.add_recording("a.cap", 2);
  (void)folder_.make({"calibrate", "surfacings"});
  const Plan plan = load_plan(folder_.plan());
  ASSERT_EQ(plan.tasks.size(), 4U);
  EXPECT_EQ(fs::path(plan.recordings.at(plan.tasks[0].recording).path).filename(), "m.cap");
  EXPECT_EQ(plan.tasks[0].job, "calibrate");
}

TEST_F(MakePlan, UsesTheNearestVehicleAboveARecordingOnlyForJobsThatNeedOne) {
  folder_.add_recording("a.cap", 1);
  folder_.add_recording("heavy/b.cap", 2);
  folder_.add_recording("heavy/deep/c.cap", 3);
  folder_.add_file("heavy/vehicle.toml", "[hull]\nmass_kg = 30\n");
  (void)folder_.make({"gap", "calibrate"});
  const Plan plan = load_plan(folder_.plan());
  std::set<std::string> heavy, light;
  for (const Task& task : plan.tasks) {
    if (task.job == "calibrate") {
      EXPECT_EQ(task.vehicle, "");
      continue;
    }
    const bool is_heavy = plan.recordings.at(task.recording).path.find("heavy") != std::string::npos;
    (is_heavy ? heavy : light).insert(task.vehicle);
  }
  EXPECT_EQ(heavy.size(), 1U);
  EXPECT_EQ(light.size(), 1U);
  EXPECT_NE(heavy, light);
  EXPECT_NE(plan.vehicles.at(*heavy.begin()).find("30"), std::string::npos);
}

TEST_F(MakePlan, ARecordingThatCannotBeReadIsATaskWithoutABank) {
  folder_.add_file("bad.cap", "no capture");
  const PlanSummary summary = folder_.make({"gap"});
  EXPECT_EQ(summary.tasks, 1U);
  EXPECT_EQ(summary.banks, 0U);
}

TEST_F(MakePlan, LeavesTheOldPlanWhereItFails) {
  folder_.add_recording("a.cap", 1);
  (void)folder_.make();
  const auto before = keys();
  folder_.add_recording("b.cap", 2);
  folder_.add_file("vehicle.toml", "[hull]\nmass_kg = \"much\"\n");
  EXPECT_THROW((void)folder_.make({"gap"}), config::Error);
  fs::remove(folder_.recordings() / "b.cap");
  EXPECT_EQ(keys(), before);
  EXPECT_THROW((void)folder_.make({"nothing"}), base::Failure);
  for (const auto& entry : fs::directory_iterator(folder_.plan())) {
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST_F(MakePlan, RefusesAFolderThatIsNotThereAndAPlanThatIsAtWork) {
  EXPECT_THROW((void)folder_.make(), base::Failure);
  folder_.add_recording("a.cap", 1);
  (void)folder_.make();
  const PlanLock held(folder_.plan());
  EXPECT_THROW((void)folder_.make(), base::Failure);
}

TEST_F(MakePlan, AFolderWithoutAPlanAndADamagedCatalogueAreBadInput) {
  EXPECT_THROW((void)load_plan(folder_.plan()), base::Failure);
  folder_.add_recording("a.cap", 1);
  (void)folder_.make();
  std::ofstream(catalogue_of(folder_.plan())) << "no database";
  EXPECT_THROW((void)load_plan(folder_.plan()), base::Failure);
}

TEST_F(MakePlan, TasksAreNamedByNumbersListsAndRanges) {
  for (int i = 0; i < 5; ++i) folder_.add_recording(std::to_string(i) + ".cap", i);
  (void)folder_.make();
  const Plan plan = load_plan(folder_.plan());
  EXPECT_EQ(tasks_named(plan, "3").size(), 1U);
  EXPECT_EQ(tasks_named(plan, "1,5").at(1)->number, 5);
  EXPECT_EQ(tasks_named(plan, "2-4,1").size(), 4U);
  for (const char* wrong : {"", "0", "6", "a", "1-", "-1", "1,", "1;2", "4-2", "99999999999"}) {
    EXPECT_THROW((void)tasks_named(plan, wrong), base::Failure) << wrong;
  }
}

}  // namespace
}  // namespace navcal::fleet
