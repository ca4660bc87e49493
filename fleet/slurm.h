// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// Slurm's commands, as far as a plan needs them (squeue(1), sbatch(1), sacct(1), scontrol(1)).
namespace navcal::fleet {

/// Slurm does not do what it is asked; what() has its own words.
class SlurmError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
/// The controller does not answer now: a restart, a network that is down.
class SlurmSilence : public SlurmError {
 public:
  using SlurmError::SlurmError;
};

/// A job array of a plan in Slurm's queue.
struct QueuedArray {
  std::string name;  ///< of the job
  std::string id;    ///< of the array, for dependencies
  std::size_t pending = 0, running = 0;
  std::string reason;  ///< Slurm's, why its first element waits; empty: none does
};

/// The user's arrays whose names begin so. Throws SlurmSilence, SlurmError.
[[nodiscard]] std::vector<QueuedArray> queued_arrays(const std::string& name_prefix);

/// Reads what `squeue --format=%j|%F|%T|%r` prints: name, array, state and reason of each element.
[[nodiscard]] std::vector<QueuedArray> arrays_in(std::string_view squeue, const std::string& name_prefix);

/// Submits a script. `after`: arrays that must have ended before. Returns the id of the array. Throws
/// SlurmSilence, SlurmError.
[[nodiscard]] std::string submit_array(const std::string& script, const std::vector<std::string>& options,
                                       const std::vector<std::string>& after);

/// The largest number of elements of an array. Throws SlurmSilence, SlurmError.
[[nodiscard]] std::size_t largest_array();

/// How Slurm's accounting says that elements of an array ended, where it keeps one: "TIMEOUT", "OUT_OF_MEMORY" ...
/// Those that ended well are left out. Empty without accounting.
[[nodiscard]] std::set<std::string> bad_ends_of(const std::string& id);

}  // namespace navcal::fleet
