// SPDX-License-Identifier: Apache-2.0
#include "fleet/slurm_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

#include "base/interruptible.h"
#include "fleet/slurm.h"
#include "fleet/worker_pool.h"

namespace navcal::fleet {
namespace {

using Tasks = std::vector<const Task*>;

void sleep_unless_interrupted(std::chrono::milliseconds time) {
  constexpr std::chrono::milliseconds kSlice{100};
  const auto end = std::chrono::steady_clock::now() + time;
  while (!base::Interruptible::interrupted() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::min(kSlice, time));
  }
}

class SlurmRun {
 public:
  SlurmRun(const Plan& plan, const SlurmOptions& options,
           const std::function<void(const SlurmProgress&)>& progress)
      : plan_(plan), options_(options), progress_(progress), results_(plan.folder), batches_(plan) {}

  std::vector<std::string> run() {
    results_.remove_leftovers();
    shown_.tasks = open_tasks(plan_, results_.states()).size();
    while (!base::Interruptible::interrupted()) {
      try {
        if (!step()) break;
      } catch (const SlurmSilence& silence) {
        shown_.remark = std::string("Slurm does not answer: ") + silence.what();
      }
      progress_(shown_);
      sleep_unless_interrupted(options_.poll);
    }
    progress_(shown_);
    return remarks_;
  }

 private:
  /// Looks at the queue and the results, and submits what is in neither. False: nothing is left to do.
  bool step() {
    // The queue first: a task that is not in it has its result by now, or will have none.
    const std::vector<QueuedArray> arrays = queued_arrays(slurm_name_of(plan_));
    const OpenTasks open = open_tasks(plan_, results_.states());
    std::set<int> queued;
    std::vector<std::string> bank_arrays;
    shown_.pending = shown_.running = 0;
    shown_.remark.clear();
    for (const QueuedArray& array : arrays) {
      const std::set<int> tasks = batches_.tasks_of(array.name);
      queued.insert(tasks.begin(), tasks.end());
      const bool has_bank = std::ranges::any_of(tasks, [&](int number) { return makes_bank(number); });
      if (has_bank) bank_arrays.push_back(array.id);
      shown_.pending += array.pending;
      shown_.running += array.running;
      if (shown_.remark.empty()) shown_.remark = array.reason;
    }
    if (shown_.running > 0) shown_.remark.clear();
    shown_.ended = shown_.tasks - std::min(shown_.tasks, open.size());
    std::set<int> absent;
    const Tasks ready = to_submit(open.ready, queued, absent), waiting = to_submit(open.waiting, queued, absent);
    absent_before_ = std::move(absent);
    try {
      submit(ready, waiting, bank_arrays);
    } catch (const SlurmSilence&) {
      throw;
    } catch (const SlurmError& error) {
      // A limit on the number of jobs: there is room once those in the queue are done.
      if (arrays.empty() && !has_submitted_) throw;
      shown_.remark = error.what();
    }
    return open.size() > given_up_.size();
  }

  [[nodiscard]] bool makes_bank(int number) const {
    const Task* const task = plan_.task(number);
    return task != nullptr && task->makes_bank();
  }

  /// Open tasks that are in no array. Of those that were in one, only what was absent at the last look, too: a
  /// network file system shows the result of another machine some seconds later.
  Tasks to_submit(const Tasks& open, const std::set<int>& queued, std::set<int>& absent) {
    Tasks found;
    for (const Task* task : open) {
      const int number = task->number;
      if (queued.contains(number) || given_up_.contains(number)) continue;
      absent.insert(number);
      const int attempts = attempts_[number];
      if (attempts > 0 && !absent_before_.contains(number)) continue;
      if (attempts < options_.attempts) {
        found.push_back(task);
      } else {
        give_up(number);
      }
    }
    return found;
  }

  void give_up(int number) {
    given_up_.insert(number);
    const std::set<std::string> ends = bad_ends_of(array_of_[number]);
    remarks_.push_back(fmt::format("task {}: no result after {} attempts{}{}; see {}", number, options_.attempts,
                                   ends.empty() ? "" : ": ", fmt::join(ends, ", "),
                                   (plan_.folder / "slurm").string()));
  }

  void submit(const Tasks& ready, const Tasks& waiting, std::vector<std::string> bank_arrays) {
    if (ready.empty() && waiting.empty()) return;
    const auto others = std::ranges::find_if(ready, [](const Task* task) { return !task->makes_bank(); });
    for (std::string& id : submit_arrays({ready.begin(), others}, {})) bank_arrays.push_back(std::move(id));
    (void)submit_arrays({others, ready.end()}, {});
    (void)submit_arrays(waiting, bank_arrays);
  }

  /// Returns the ids of the arrays.
  std::vector<std::string> submit_arrays(const Tasks& tasks, const std::vector<std::string>& after) {
    std::vector<std::string> ids;
    if (tasks.empty()) return ids;
    if (largest_ == 0) largest_ = largest_array();
    const std::size_t most = largest_ * options_.chunk;
    for (std::size_t i = 0; i < tasks.size(); i += most) {
      const auto end = static_cast<std::ptrdiff_t>(std::min(tasks.size(), i + most));
      const Tasks part(tasks.begin() + static_cast<std::ptrdiff_t>(i), tasks.begin() + end);
      ids.push_back(submit_array(batches_.write(part, options_).script.string(), sbatch_options(), after));
      has_submitted_ = true;
      for (const Task* task : part) {
        ++attempts_[task->number];
        array_of_[task->number] = ids.back();
      }
    }
    return ids;
  }

  [[nodiscard]] std::vector<std::string> sbatch_options() const {
    // % begins a replacement symbol in a file name of Slurm's.
    std::string folder;
    for (const char c : (plan_.folder / "slurm").string())
      folder += c == '%' ? std::string("%%") : std::string(1, c);
    std::vector<std::string> all{"--output=" + folder + "/%x-%a.log", "--open-mode=append", "--chdir=/"};
    all.insert(all.end(), options_.options.begin(), options_.options.end());
    return all;
  }

  const Plan& plan_;
  const SlurmOptions& options_;
  const std::function<void(const SlurmProgress&)>& progress_;
  ResultStore results_;
  SlurmBatches batches_;
  std::size_t largest_ = 0;
  std::map<int, int> attempts_;             ///< arrays of this command that had the task
  std::map<int, std::string> array_of_;     ///< the last of them
  std::set<int> absent_before_, given_up_;  ///< numbers of tasks
  bool has_submitted_ = false;
  SlurmProgress shown_;
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<std::string> run_by_slurm(const Plan& plan, const SlurmOptions& options,
                                      const std::function<void(const SlurmProgress&)>& progress) {
  return SlurmRun(plan, options, progress).run();
}

}  // namespace navcal::fleet
