// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "analysis/failure.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "record/log/log_info.h"
#include "record/recording.h"

namespace navcal::cli {

/// Runs a job on a log with progress; turns what it throws into the statuses of the contract.
template <class Job>
auto run_log_job(Job job) {
  const base::Interruptible interruptible;
  analysis::Progress progress("log");
  return job(record::Progress([&progress](double done) {
    if (base::Interruptible::interrupted())
      throw analysis::Failure(analysis::Exit::failed, "interrupted: nothing was written");
    progress.show(done);
  }));
}

}  // namespace navcal::cli
