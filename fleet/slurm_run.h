// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "fleet/plan.h"
#include "fleet/result_store.h"

namespace navcal::fleet {

struct SlurmOptions {
  std::filesystem::path program;     ///< navcal, as the nodes see it
  std::vector<std::string> options;  ///< for sbatch: "--partition=long"
  std::size_t chunk = 1;             ///< tasks of one array element, one after the other
  unsigned threads = 1;              ///< of a task, and cores that an element asks for
  int attempts = 3;  ///< arrays in which a task may end without a result, beyond what Slurm requeues
  std::chrono::milliseconds poll{5000};
};

/// How far a plan has come.
struct SlurmProgress {
  std::size_t tasks = 0, ended = 0;      ///< that were open when the command began
  std::size_t pending = 0, running = 0;  ///< array elements
  std::string remark;                    ///< why Slurm waits, or that it does not answer
};

/// Submits all open tasks as job arrays, null banks first, and follows them until each has a result. Arrays of
/// this plan that are in Slurm's queue already are followed and not submitted once more, so a client that was
/// interrupted goes on where it was. A controller that does not answer is waited for. Tasks whose array has ended
/// without a result are submitted again. Returns on Ctrl-C, too: what is in the queue stays there. Returns remarks
/// on tasks that were given up. Throws SlurmError, std::system_error.
[[nodiscard]] std::vector<std::string> run_by_slurm(const Plan& plan, const SlurmOptions& options,
                                                    const std::function<void(const SlurmProgress&)>& progress);

/// Beginning of the names of a plan's arrays in Slurm's queue.
[[nodiscard]] std::string slurm_name_of(const Plan& plan);

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
