// SPDX-License-Identifier: Apache-2.0
#include "fleet/local_run.h"

#include <algorithm>
#include <set>
#include <string>

#include "base/interruptible.h"

namespace navcal::fleet {

OpenTasks open_tasks(const Plan& plan, const ResultStore::States& states) {
  std::set<std::string> unmade;
  for (const Task& task : plan.tasks) {
    if (task.makes_bank() && state_in(states, task) == TaskState::open) unmade.insert(task.bank);
  }
  OpenTasks open;
  for (const Task& task : plan.tasks) {
    if (state_in(states, task) != TaskState::open) continue;
    const bool waits = !task.makes_bank() && !task.bank.empty() && unmade.contains(task.bank);
    (waits ? open.waiting : open.ready).push_back(&task);
  }
  std::stable_partition(open.ready.begin(), open.ready.end(), [](const Task* task) { return task->makes_bank(); });
  return open;
}

void run_locally(const Plan& plan, const PoolOptions& options, const TaskEnded& ended) {
  const ResultStore results(plan.folder);
  results.remove_leftovers();
  const OpenTasks open = open_tasks(plan, results.states());
  run_in_processes(plan, open.ready, options, ended);
  if (base::Interruptible::interrupted()) return;
  run_in_processes(plan, open.waiting, options, ended);
}

}  // namespace navcal::fleet
