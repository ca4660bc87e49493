// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "fleet/slurm_run.h"

namespace navcal::fleet {

/// The files of a plan's job arrays, PLAN/slurm/: N.tasks has the tasks of each element of array N, one element a
/// line; N.sh is its script; N-K.log is what element K printed.
class SlurmBatches {
 public:
  explicit SlurmBatches(const Plan& plan);

  /// Writes tasks and script of a new array. Throws std::system_error.
  struct Written {
    std::string name;              ///< of the job
    std::filesystem::path script;  ///< for sbatch
  };
  [[nodiscard]] Written write(const std::vector<const Task*>& tasks, const SlurmOptions& options);
  /// Numbers of the tasks of an array, by the name of its job.
  [[nodiscard]] std::set<int> tasks_of(const std::string& name) const;

 private:
  const Plan& plan_;
  std::filesystem::path folder_;
  int last_ = 0;  ///< number of the last array
};

/// A text as one word of a shell.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace navcal::fleet
