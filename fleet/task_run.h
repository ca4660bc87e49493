// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

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

}  // namespace navcal::fleet
