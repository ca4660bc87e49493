// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "fleet/plan.h"
#include "fleet/slurm.h"
#include "fleet/slurm_run.h"
#include "fleet/worker_pool.h"

namespace navcal::cli {
namespace {

struct SubmitOptions {
  std::string plan;
  bool local = false, slurm = false, again = false;
  unsigned jobs = 0, threads = 0;
  fleet::SlurmOptions by_slurm;
  double poll_s = 5;
};

/// What stands at the end of a submission, and the failure where tasks are left.
void conclude(const fleet::Plan& plan, const std::string& hint) {
  const fleet::ResultStore::States states = fleet::ResultStore(plan.folder).states();
  std::size_t done = 0, failed = 0, open = 0;
  for (const fleet::Task& task : plan.tasks) {
    const fleet::TaskState state = state_in(states, task);
    (state == fleet::TaskState::done ? done : state == fleet::TaskState::failed ? failed : open) += 1;
  }
  fmt::print("{} tasks: {} done, {} failed, {} open\n", plan.tasks.size(), done, failed, open);
  if (failed > 0) fmt::print("Errors: navcal fleet list {}\n", plan.folder.string());
  if (base::Interruptible::interrupted()) throw base::Failure(base::Exit::failed, "interrupted; " + hint);
  if (open > 0) {
    throw base::Failure(base::Exit::failed, fmt::format("{} tasks have no result; {}", open, hint));
  }
}

void submit_locally(const SubmitOptions& options, const fleet::Plan& plan) {
  const fleet::ResultStore results(plan.folder);
  const unsigned cores = base::threads_or_cores();
  const unsigned jobs = options.jobs > 0 ? options.jobs : cores;
  const unsigned threads = options.threads > 0 ? options.threads : std::max(1U, cores / jobs);
  const std::size_t open = open_tasks(plan, results.states()).size();
  {
    base::Progress progress("fleet submit", base::Progress::Answer::at_the_end);
    std::size_t ended = 0;
    fleet::run_locally(plan, {jobs, threads}, [&](const fleet::Task& task, const fleet::Attempt& attempt) {
      ++ended;
      if (!attempt.why.empty())
        fmt::print(stderr, "navcal fleet: task {}: {}\n", task.number, base::printable(attempt.why));
      progress.show(fmt::format("{} of {} tasks", ended, open),
                    static_cast<double>(ended) / static_cast<double>(open));
    });
  }
  conclude(plan, "the same command goes on with them");
}

void submit_to_slurm(const SubmitOptions& options, const fleet::Plan& plan) {
  fleet::SlurmOptions by_slurm = options.by_slurm;
  if (by_slurm.program.empty()) by_slurm.program = std::filesystem::read_symlink("/proc/self/exe");
  by_slurm.threads = std::max(1U, options.threads);
  by_slurm.poll = std::chrono::milliseconds(static_cast<int>(options.poll_s * 1000));
  std::vector<std::string> remarks;
  try {
    base::Progress progress("fleet submit", base::Progress::Answer::at_the_end);
    remarks = fleet::run_by_slurm(plan, by_slurm, [&](const fleet::SlurmProgress& now) {
      std::string words = fmt::format("{} of {} tasks, {} elements running, {} pending", now.ended, now.tasks,
                                      now.running, now.pending);
      if (!now.remark.empty()) words += fmt::format(" ({})", now.remark);
      progress.show(words, now.tasks == 0 ? 1 : static_cast<double>(now.ended) / static_cast<double>(now.tasks));
    });
  } catch (const fleet::SlurmError& error) {
    throw base::Failure(base::Exit::failed, std::string("Slurm: ") + error.what());
  }
  tell_remarks("navcal fleet", remarks);
  conclude(plan, base::Interruptible::interrupted()
                     ? fmt::format("what is in Slurm's queue goes on. The same command follows it; \"squeue --me "
                                   "--format=%A,%j | grep {}\" lists it for scancel",
                                   fleet::slurm_name_of(plan))
                     : "the same command tries them again");
}

void submit(const SubmitOptions& options) {
  const base::Interruptible interruptible;
  const fleet::Plan plan = fleet::load_plan(options.plan);
  const fleet::PlanLock lock(plan.folder);
  if (options.again) {
    const fleet::ResultStore results(plan.folder);
    for (const fleet::Task& task : plan.tasks) results.forget_error(task);
  }
  if (options.slurm) {
    submit_to_slurm(options, plan);
  } else {
    submit_locally(options, plan);
  }
}

}  // namespace

void add_fleet_submit(CLI::App& fleet) {
  auto* command = fleet.add_subcommand("submit", "do all open tasks of a plan, on this machine or by Slurm");
  const auto options = std::make_shared<SubmitOptions>();
  command->add_option("PLAN", options->plan)->required();
  auto* const local = command->add_flag("--local", options->local);
  auto* const slurm = command->add_flag("--slurm", options->slurm);
  slurm->excludes(local);
  command->add_option("--jobs", options->jobs)->check(CLI::Range(1, 1024))->needs(local);
  command->add_option("--threads", options->threads)->check(CLI::Range(1, 1024));
  command->add_flag("--again", options->again);
  const auto* const by_slurm = "Slurm";
  add_repeatable(command, "--sbatch", "OPTION", options->by_slurm.options)->needs(slurm)->group(by_slurm);
  add_number(command, "--chunk", 1, 100'000, options->by_slurm.chunk)->needs(slurm)->group(by_slurm);
  add_number(command, "--attempts", 1, 100, options->by_slurm.attempts)->needs(slurm)->group(by_slurm);
  add_number(command, "--poll", 0.1, 3600.0, options->poll_s)->needs(slurm)->group(by_slurm);
  add_valued(command, "--program", "FILE", options->by_slurm.program)->needs(slurm)->group(by_slurm);
  command->callback([options] {
    if (!options->local && !options->slurm) throw CLI::RequiredError("one of --local and --slurm");
    submit(*options);
  });
}

}  // namespace navcal::cli
