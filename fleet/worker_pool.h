// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

/// How an attempt at a task ended.
struct Attempt {
  TaskState state = TaskState::open;
  std::string why;  ///< the error; of an open task, why there is no result
};

/// Does a task in this process and keeps its result. A task that has one is not done again. An error that the
/// recording causes is a result. What the machine causes (a full disk, a file that is gone) is none: the task
/// stays open and can be tried again.
[[nodiscard]] Attempt run_task(const Plan& plan, const Task& task, unsigned threads);

struct PoolOptions {
  unsigned jobs = 1;     ///< tasks at a time
  unsigned threads = 1;  ///< of each task
  /// What is done in each process.
  std::function<Attempt(const Plan&, const Task&, unsigned threads)> run = run_task;
};

/// Called for each task that ended, in the order in which they end.
using TaskEnded = std::function<void(const Task&, const Attempt&)>;

/// Does tasks in processes of this machine, one process for each: a recording on which the program crashes costs
/// its own task only, whose result is the signal then. Begins them in the order given. Ctrl-C
/// (base::Interruptible) and the end of this process end the tasks that run; they leave nothing behind and stay
/// open. The calling process must have one thread. Throws std::system_error when no process can be made.
void run_in_processes(const Plan& plan, const std::vector<const Task*>& tasks, const PoolOptions& options,
                      const TaskEnded& ended);

/// Does all open tasks in processes of this machine, null banks and tasks that need none first. Ends early on
/// Ctrl-C. `ended` gets those that were done now.
void run_locally(const Plan& plan, const PoolOptions& options, const TaskEnded& ended);

/// The tasks that are open: those that wait for no null bank that is still to be made, banks first; and the rest.
struct OpenTasks {
  std::vector<const Task*> ready, waiting;

  [[nodiscard]] std::size_t size() const { return ready.size() + waiting.size(); }
};
[[nodiscard]] OpenTasks open_tasks(const Plan& plan, const ResultStore::States& states);

}  // namespace navcal::fleet
