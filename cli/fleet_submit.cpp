// SPDX-License-Identifier: Apache-2.0
#include "cli/fleet_submit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "analysis/failure.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "fleet/local_run.h"

namespace navcal::cli {
namespace {

struct SubmitOptions {
  std::string plan;
  bool local = false, slurm = false, again = false;
  unsigned jobs = 0, threads = 0;
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
  if (base::Interruptible::interrupted()) throw analysis::Failure(analysis::Exit::failed, "interrupted; " + hint);
  if (open > 0) {
    throw analysis::Failure(analysis::Exit::failed, fmt::format("{} tasks have no result; {}", open, hint));
  }
}

void submit_locally(const SubmitOptions& options) {
  const base::Interruptible interruptible;
  const fleet::Plan plan = fleet::load_plan(options.plan);
  const fleet::ResultStore results(plan.folder);
  if (options.again) {
    for (const fleet::Task& task : plan.tasks) results.forget_error(task);
  }
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  const unsigned jobs = options.jobs > 0 ? options.jobs : cores;
  const unsigned threads = options.threads > 0 ? options.threads : std::max(1U, cores / jobs);
  const std::size_t open = open_tasks(plan, results.states()).size();
  {
    analysis::Progress progress("fleet submit");
    std::size_t ended = 0;
    fleet::run_locally(plan, {jobs, threads}, [&](const fleet::Task& task, const fleet::Attempt& attempt) {
      ++ended;
      if (!attempt.why.empty()) fmt::print(stderr, "navcal fleet: task {}: {}\n", task.number, attempt.why);
      progress.show(fmt::format("{} of {} tasks", ended, open),
                    static_cast<double>(ended) / static_cast<double>(open));
    });
  }
  conclude(plan, "the same command goes on with them");
}

}  // namespace

void add_fleet_submit(CLI::App& fleet) {
  auto* command = fleet.add_subcommand("submit", "do all open tasks of a plan, on this machine or by Slurm");
  const auto options = std::make_shared<SubmitOptions>();
  command->add_option("PLAN", options->plan, "folder of the plan")->required();
  auto* const local = command->add_flag("--local", options->local, "in processes of this machine");
  command->add_option("--jobs", options->jobs, "tasks at a time; default: one for each core")
      ->check(CLI::Range(1, 1024))
      ->needs(local);
  command->add_option("--threads", options->threads, "threads of a task; they change no result")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--again", options->again, "do tasks once more that failed");
  command->footer(
      "Tasks that have a result are not done again. Ctrl-C ends the command, and the same command goes on.\n\n"
      "Example: navcal fleet submit plan/ --local --jobs 4");
  command->callback([options] {
    try {
      submit_locally(*options);
    } catch (const std::system_error& error) {
      throw analysis::Failure(analysis::Exit::failed, error.what());
    }
  });
}

}  // namespace navcal::cli
