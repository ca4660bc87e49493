// SPDX-License-Identifier: Apache-2.0
// Whatever squeue prints, a user gives as tasks, or a result has in it: arrays of the plan only, tasks of the plan
// only, and tables that are whole.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/failure.h"
#include "fleet/merge.h"
#include "fleet/slurm.h"
#include "tests/fuzz/target.h"

namespace navcal::fuzz::fleet_target {

NAVCAL_FUZZ(fleet) {
  using namespace navcal::fleet;
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const QueuedArray& array : arrays_in(text, "navcal-a-")) {
    if (!array.name.starts_with("navcal-a-") || array.pending + array.running == 0) std::abort();
  }
  Plan plan;
  for (int number = 2; number < 20; number += 3) {
    plan.tasks.emplace_back();
    plan.tasks.back().number = number;
  }
  try {
    for (const Task* task : tasks_named(plan, text)) {
      if (plan.task(task->number) != task) std::abort();
    }
  } catch (const navcal::base::Failure&) {
  }
  for (const char* job : {"gap", "calibrate"}) {
    Database database(":memory:", Database::Access::create);
    make_merge_tables(database);
    MergeTables tables(database);
    Task task;
    task.number = 1;
    task.job = job;
    try {
      tables.add_task(task, TaskState::done, text);
    } catch (const DatabaseError&) {
    }
  }
  return 0;
}

}  // namespace navcal::fuzz::fleet_target
