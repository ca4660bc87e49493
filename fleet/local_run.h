// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fleet/worker_pool.h"

namespace navcal::fleet {

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
