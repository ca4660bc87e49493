// SPDX-License-Identifier: Apache-2.0
#include "fleet/worker_pool.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/descriptor.h"
#include "base/interruptible.h"
#include "base/spawn.h"
#include "config/layout/layout_file.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "fleet/catalogue.h"
#include "fleet/jobs.h"
#include "fleet/whole_writing.h"
#include "record/content_hash.h"

namespace navcal::fleet {
namespace {

namespace fs = std::filesystem;

/// No result, for a reason that lies outside of the recording.
class NotNow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The file of a recording, which must have the content that was planned.
fs::path file_of(const Plan& plan, const std::string& recording) {
  const auto found = plan.recordings.find(recording);
  if (found == plan.recordings.end()) throw NotNow("the recording is gone");
  const RecordingFile& planned = found->second;
  RecordingFile now = planned;
  if (!look_at(now)) throw NotNow(planned.path + ": the file is gone; make the plan once more");
  const bool is_unchanged = now.bytes == planned.bytes && now.modified_ns == planned.modified_ns;
  if (!is_unchanged && record::sha256_of_file(planned.path) != recording) {
    throw NotNow(planned.path + ": it has changed since it was planned; make the plan once more");
  }
  return planned.path;
}

/// Folder of the null bank that a task uses; empty: it has none, or none can be made of that mission.
fs::path bank_used(const Plan& plan, const Task& task) {
  if (task.bank.empty()) return {};
  const Task* const maker = plan.maker_of(task.bank);
  if (maker == nullptr) throw NotNow("the plan has no task that makes the null bank " + task.bank);
  switch (ResultStore(plan.folder).state_of(*maker)) {
    case TaskState::done: return plan.bank_folder(task.bank);
    case TaskState::failed: return {};
    default: throw NotNow(fmt::format("its null bank is not made yet (task {})", maker->number));
  }
}

std::string answer_of(const Plan& plan, const Task& task, unsigned threads) {
  JobInput input;
  input.recording = file_of(plan, task.recording);
  if (!task.vehicle.empty()) {
    const std::string& toml = plan.vehicles.at(task.vehicle);
    if (config::is_layout(toml)) {
      input.layout = config::parse_layout(toml, "vehicle");
    } else {
      input.vehicle = config::parse_vehicle(toml, "vehicle");
    }
    if (const auto found = plan.nominals.find(task.vehicle); found != plan.nominals.end())
      for (const std::string& nominal : found->second) input.nominals.push_back(file_of(plan, nominal));
  }
  if (!task.configuration.empty()) {
    input.settings = config::parse(plan.configurations.at(task.configuration), "configuration");
  }
  input.bank_missions = task.bank_missions;
  input.bank_seed = task.bank_seed;
  input.threads = threads;
  if (!task.makes_bank()) {
    input.bank_folder = bank_used(plan, task);
    return job_named(task.job).answer(input);
  }
  const fs::path folder = plan.bank_folder(task.bank);
  fs::create_directories(folder.parent_path());
  input.bank_folder = part_of(folder);
  fs::remove_all(input.bank_folder);
  try {
    std::string answer = bank_job().answer(input);
    rename_whole(input.bank_folder, folder);
    return answer;
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(input.bank_folder, ignored);
    throw;
  }
}

}  // namespace

Attempt run_task(const Plan& plan, const Task& task, unsigned threads) {
  const ResultStore results(plan.folder);
  if (const TaskState before = results.state_of(task); before != TaskState::open) {
    return {before, before == TaskState::failed ? results.text_of(task, before).value_or("") : std::string()};
  }
  std::string error;
  try {
    results.keep_answer(task, answer_of(plan, task, threads));
    return {TaskState::done, {}};
  } catch (const NotNow& reason) {
    return {TaskState::open, reason.what()};
  } catch (const std::system_error& reason) {
    return {TaskState::open, reason.what()};
  } catch (const std::bad_alloc&) {
    return {TaskState::open, "out of memory"};
  } catch (const std::exception& reason) {
    error = reason.what();
  }
  try {
    results.keep_error(task, error);
    return {TaskState::failed, error};
  } catch (const std::system_error& reason) {
    return {TaskState::open, reason.what()};
  }
}

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

namespace {

using PoolClock = std::chrono::steady_clock;

/// Signals by which a program says that it is wrong: they come again with the same recording. Others come from
/// outside (a limit of memory, an operator), and say nothing about the recording.
constexpr std::array kCrashes{SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP};

[[noreturn]] void fail_of(const std::string& call) { throw std::system_error(base::last_error(), call); }

/// A task in a process of its own, with a pipe through which the process says why it has no result.
class Worker {
 public:
  Worker(const Plan& plan, const Task& task, const PoolOptions& options) : task_(&task) {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) fail_of("pipe");
    said_ = base::Descriptor(pipe[0]);
    const base::Descriptor says(pipe[1]);
    const pid_t parent = ::getpid();
    pid_ = ::fork();
    if (pid_ < 0) fail_of("fork");
    if (pid_ == 0) work(plan, parent, options, says.get());
    // Debian 12's <sys/pidfd.h> cannot be used from C++: it lacks the extern "C".
    end_ = base::Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
    if (!end_) {
      const int error = errno;
      ::kill(pid_, SIGKILL);
      (void)base::wait_for(pid_);
      throw std::system_error(error, std::system_category(), "pidfd_open");
    }
  }

  [[nodiscard]] const Task& task() const { return *task_; }
  [[nodiscard]] int end() const { return end_.get(); }
  void signal(int number) const { ::kill(pid_, number); }

  /// Waits for the end, and says what became of the task.
  [[nodiscard]] Attempt attempt(const ResultStore& results) const {
    const int status = base::wait_for(pid_);
    const TaskState state = results.state_of(*task_);
    if (state == TaskState::failed) return {state, results.text_of(*task_, state).value_or("")};
    if (state == TaskState::done) return {state, {}};
    if (!WIFSIGNALED(status)) return {TaskState::open, words()};
    results.remove_leftovers();
    const int number = WTERMSIG(status);
    const std::string why = fmt::format("it was ended by signal {} ({})", number, ::strsignal(number));
    if (std::find(kCrashes.begin(), kCrashes.end(), number) == kCrashes.end()) return {TaskState::open, why};
    try {
      results.keep_error(*task_, why);
      return {TaskState::failed, why};
    } catch (const std::system_error& error) {
      return {TaskState::open, why + "; " + error.what()};
    }
  }

 private:
  [[noreturn]] void work(const Plan& plan, pid_t parent, const PoolOptions& options, int says) const {
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
    // A terminal's Ctrl-C is the parent's to pass on; with the parent this process ends, too.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(EXIT_FAILURE);
    const Attempt made = attempt_in_child(plan, options);
    if (made.state == TaskState::open) {
      const auto length = std::min<std::size_t>(made.why.size(), PIPE_BUF);
      (void)!::write(says, made.why.data(), length);
    }
    // Not exit(): it would write the parent's buffers once more.
    ::_exit(made.state == TaskState::open ? EXIT_FAILURE : EXIT_SUCCESS);
  }
  /// No exception may reach the frames of the parent.
  [[nodiscard]] Attempt attempt_in_child(const Plan& plan, const PoolOptions& options) const {
    try {
      return options.run(plan, *task_, options.threads);
    } catch (const std::exception& error) {
      return {TaskState::open, error.what()};
    }
  }
  [[nodiscard]] std::string words() const {
    std::array<char, PIPE_BUF> text{};
    const ssize_t length = ::read(said_.get(), text.data(), text.size());
    if (length <= 0) return "it ended without a result";
    return {text.data(), static_cast<std::size_t>(length)};
  }

  const Task* task_;
  pid_t pid_ = -1;
  base::Descriptor said_, end_;  ///< end_ is readable once the process has ended
};

class Pool {
 public:
  Pool(const Plan& plan, const PoolOptions& options, const TaskEnded& ended)
      : plan_(plan), options_(options), results_(plan.folder), ended_(ended) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() { end_all(); }

  void run(const std::vector<const Task*>& tasks) {
    auto next = tasks.begin();
    while (!base::Interruptible::interrupted()) {
      while (workers_.size() < options_.jobs && next != tasks.end()) {
        workers_.emplace_back(plan_, **next++, options_);
      }
      if (workers_.empty()) return;
      collect(ended_);
    }
  }

 private:
  static constexpr std::chrono::milliseconds kLook{200};

  /// Waits for a process to end, not longer than kLook, and hands on those that did to `ended`.
  void collect(const TaskEnded& ended) {
    std::vector<pollfd> waiting;
    for (const Worker& worker : workers_) waiting.push_back({worker.end(), POLLIN, 0});
    if (::poll(waiting.data(), waiting.size(), static_cast<int>(kLook.count())) <= 0) return;
    for (std::size_t i = waiting.size(); i-- > 0;) {
      if (waiting[i].revents == 0) continue;
      const Worker worker = std::move(workers_[i]);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      ended(worker.task(), worker.attempt(results_));
    }
  }
  /// Asks all processes to end, and kills those that do not within two seconds.
  void end_all() {
    constexpr std::chrono::seconds kGrace{2};
    for (const Worker& worker : workers_) worker.signal(SIGTERM);
    const auto limit = PoolClock::now() + kGrace;
    while (!workers_.empty()) {
      const bool is_late = PoolClock::now() >= limit;
      for (const Worker& worker : workers_) {
        if (is_late) worker.signal(SIGKILL);
      }
      collect([](const Task&, const Attempt&) {});
    }
  }

  const Plan& plan_;
  const PoolOptions& options_;
  ResultStore results_;
  const TaskEnded& ended_;
  std::vector<Worker> workers_;
};

}  // namespace

void run_in_processes(const Plan& plan, const std::vector<const Task*>& tasks, const PoolOptions& options,
                      const TaskEnded& ended) {
  Pool(plan, options, ended).run(tasks);
}

}  // namespace navcal::fleet
