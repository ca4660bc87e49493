// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "analysis/failure.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "base/printable.h"
#include "config/load.h"
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

inline void tell_remarks(const std::vector<std::string>& remarks) {
  for (const auto& remark : remarks) fmt::print(stderr, "navcal log: {}\n", base::printable(remark));
}

}  // namespace navcal::cli
