// SPDX-License-Identifier: Apache-2.0
#include "fleet/slurm.h"

#include <gtest/gtest.h>

#include "base/spawn.h"
#include "fleet/slurm_run.h"
#include "fleet/worker_pool.h"
#include "tests/fleet/fleet_folder.h"

namespace navcal::fleet {
namespace {

TEST(Slurm, CountsTheElementsOfEachArrayOfThePlan) {
  const auto arrays = arrays_in(
      "navcal-a-1|12|RUNNING|None\nnavcal-a-1|12|PENDING|Resources\nnavcal-a-2|13|PENDING|Dependency\n"
      "navcal-b-1|14|RUNNING|None\nnavcal-a-1|12|COMPLETING|None\nnavcal-a-3|15|COMPLETED|None\n",
      "navcal-a-");
  ASSERT_EQ(arrays.size(), 2U);
  EXPECT_EQ(arrays[0].id, "12");
  EXPECT_EQ(arrays[0].running, 2U);
  EXPECT_EQ(arrays[0].pending, 1U);
  EXPECT_EQ(arrays[0].reason, "Resources");
  EXPECT_EQ(arrays[1].name, "navcal-a-2");
  EXPECT_EQ(arrays[1].running, 0U);
}

TEST(Slurm, LinesThatAreNoneAreNoArrays) {
  for (const char* text : {"", "\n", "|", "x|1|RUNNING|None", "navcal-a-", "navcal-a-|", "|||\n\n|"}) {
    for (const QueuedArray& array : arrays_in(text, "navcal-a-")) EXPECT_TRUE(array.name.starts_with("navcal-a-"));
  }
}

TEST(Slurm, AnyNameIsOneWordOfAShell) {
  for (const std::string text : {"plain", "two words", "it's", "$HOME `x` \"y\" \\", ""}) {
    EXPECT_EQ(base::run_command({"sh", "-c", "printf %s " + shell_word(text)}).out, text);
  }
}

TEST(Slurm, ABatchHasItsTasksByLineAndGivesThemBack) {
  test::FleetFolder folder;
  for (int i = 0; i < 5; ++i) folder.add_recording(std::to_string(i) + ".cap", i);
  (void)folder.make();
  const Plan plan = load_plan(folder.plan());
  std::vector<const Task*> tasks;
  for (const Task& task : plan.tasks) tasks.push_back(&task);
  SlurmOptions options;
  options.program = "/a program";
  options.chunk = 2;
  SlurmBatches batches(plan);
  const auto written = batches.write(tasks, options);
  EXPECT_EQ(navcal::test::read_file(plan.folder / "slurm" / "1.tasks"), "1,2\n3,4\n5\n");
  const std::string script = navcal::test::read_file(written.script);
  EXPECT_NE(script.find("--array=0-2 "), std::string::npos) << script;
  EXPECT_NE(script.find("exec '/a program' fleet run "), std::string::npos) << script;
  EXPECT_EQ(SlurmBatches(plan).tasks_of(written.name), (std::set{1, 2, 3, 4, 5}));
  EXPECT_TRUE(batches.tasks_of("navcal-x-99").empty());
  EXPECT_TRUE(SlurmBatches(plan).write(tasks, options).name.ends_with("-2"));
}

TEST(Slurm, BanksComeFirstAndTheirUsersWait) {
  Plan plan;
  const auto add = [&](std::string job, std::string bank) {
    Task task;
    task.number = static_cast<int>(plan.tasks.size()) + 1;
    task.key = std::to_string(task.number);
    task.job = std::move(job);
    task.bank = std::move(bank);
    plan.tasks.push_back(std::move(task));
  };
  add("gap", "a");
  add("calibrate", "");
  add("gap", "b");
  add("bank", "a");
  add("bank", "b");
  const OpenTasks open = open_tasks(plan, {{"5", TaskState::done}});
  ASSERT_EQ(open.ready.size(), 3U);
  EXPECT_EQ(open.ready[0]->number, 4);
  EXPECT_EQ(open.ready[1]->number, 2);
  EXPECT_EQ(open.ready[2]->number, 3);
  ASSERT_EQ(open.waiting.size(), 1U);
  EXPECT_EQ(open.waiting[0]->number, 1);
  const OpenTasks after = open_tasks(plan, {{"5", TaskState::done}, {"4", TaskState::failed}});
  EXPECT_TRUE(after.waiting.empty());
}

}  // namespace
}  // namespace navcal::fleet
