// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/interruptible.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "fleet/causes/answer_report.h"
#include "fleet/causes/read_missions.h"
#include "fleet/jobs.h"
#include "fleet/make_plan.h"
#include "fleet/merge.h"
#include "fleet/plan_report.h"
#include "fleet/worker_pool.h"
#include "gap/thresholds.h"
#include "record/whole_file.h"

namespace navcal::cli {
namespace {

namespace fs = std::filesystem;

void make_fleet_plan(fleet::PlanRequest request) {
  const base::Interruptible interruptible;
  request.threads = base::threads_or_cores();
  fleet::PlanSummary summary;
  {
    base::Progress progress("fleet plan", base::Progress::Answer::at_the_end);
    summary = fleet::make_plan(request, [&](std::string_view what, double done) { progress.show(what, done); });
  }
  tell_remarks("navcal fleet", summary.remarks);
  fmt::print(
      "{} recordings in {} ({} read now); plan {}: {} recordings, {} tasks ({} new), {} of them null banks\n",
      summary.files, request.recordings.string(), summary.read, request.plan.string(), summary.recordings,
      summary.tasks, summary.added, summary.banks);
  if (summary.gone > 0) fmt::print("{} files of the earlier plan are gone\n", summary.gone);
}

void run_fleet_tasks(const std::string& folder, const std::string& tasks, bool again, unsigned threads) {
  const base::Interruptible interruptible;
  const fleet::Plan plan = fleet::load_plan(folder);
  const std::vector<const fleet::Task*> wanted = fleet::tasks_named(plan, tasks);
  const fleet::ResultStore results(plan.folder);
  if (again) {
    for (const fleet::Task* task : wanted) results.forget_error(*task);
  }
  std::size_t ended = 0, open = 0;
  fleet::run_in_processes(plan, wanted, {1, threads}, [&](const fleet::Task& task, const fleet::Attempt& attempt) {
    ++ended;
    if (attempt.state == fleet::TaskState::open) ++open;
    if (!attempt.why.empty())
      fmt::print(stderr, "navcal fleet: task {}: {}\n", task.number, base::printable(attempt.why));
  });
  if (ended < wanted.size()) throw base::Failure(base::Exit::failed, "interrupted");
  if (open > 0) {
    throw base::Failure(base::Exit::failed,
                        fmt::format("{} of {} tasks have no result; they can be tried again", open, ended));
  }
}

void merge_fleet(const std::string& folder, const std::string& output, const std::string& page) {
  const fleet::Plan plan = fleet::load_plan(folder);
  const fs::path file = output.empty() ? plan.folder / "results.sqlite" : fs::path(output);
  expect_results({fleet::catalogue_of(plan.folder)}, {file, page});
  if (record::is_written_in_place(file))
    throw base::Failure(base::Exit::usage, file.string() + ": a database needs an ordinary file");
  const fleet::MergeSummary summary = fleet::merge(plan, file);
  if (!page.empty()) write_result(page, fleet::merge_page(plan, fleet::ResultStore(plan.folder)));
  fmt::print("{}: {} tasks done, {} failed, {} open\n", file.string(), summary.done, summary.failed, summary.open);
}

struct CausesOptions {
  std::string plan, json, page;
  unsigned threads = 0;
};

void tell_causes(const CausesOptions& options) {
  const base::Interruptible interruptible;
  const fleet::Plan plan = fleet::load_plan(options.plan);
  expect_results({fleet::catalogue_of(plan.folder)}, {options.json, options.page});
  const fleet::ResultStore results(plan.folder);
  fleet::MissionsRead read = fleet::read_missions(plan, results);
  if (read.missions.empty()) {
    throw base::Failure(
        base::Exit::bad_input,
        fmt::format("{}: no mission has an answer of the job evidence ({} open, {} failed); plan it with: navcal "
                    "fleet plan FOLDER -o {} --job evidence, and do it with: navcal fleet submit {} --local",
                    options.plan, read.open, read.failed, options.plan, options.plan));
  }
  if (read.open > 0) {
    read.remarks.push_back(fmt::format("{} recordings have no answer yet (navcal fleet submit)", read.open));
  }
  const std::vector<fleet::CalibrationHistory> calibrations = fleet::read_calibrations(plan, results);
  const fleet::PooledMissions missions(std::move(read.missions));
  const unsigned threads = base::threads_or_cores(options.threads);
  fleet::FleetAnswer answer;
  {
    base::Progress progress("fleet causes", base::Progress::Answer::at_the_end);
    answer = fleet::answer_of_fleet(missions, threads, [&](double done) {
      if (base::Interruptible::interrupted()) throw base::Failure(base::Exit::failed, "interrupted");
      progress.show("comparing causes", done);
    });
  }
  const fleet::FleetStory story{missions, answer, calibrations, read.remarks};
  if (!options.page.empty()) write_result(options.page, fleet::fleet_page(story));
  give_answer(options.json, options.json.empty() ? std::string() : fleet::fleet_json(story),
              fleet::fleet_text(story));
}

void list_fleet(const std::string& folder, bool json) {
  const fleet::Plan plan = fleet::load_plan(folder);
  const fleet::ResultStore results(plan.folder);
  print_answer(json ? fleet::list_json(plan, results) : fleet::list_text(plan, results));
}

void add_fleet_plan(CLI::App& parent) {
  auto* command = parent.add_subcommand("plan", "make or extend a plan for the recordings of a folder");
  const auto request = std::make_shared<fleet::PlanRequest>();
  command->add_option("FOLDER", request->recordings)->required();
  add_valued(command, "-o,--output", "PLAN", request->plan)->required();
  add_valued(command, "--vehicle", "FILE.toml", request->vehicle);
  add_repeatable(command, "--nominal", "FILE", request->nominals);
  add_valued(command, "--config", "FILE.toml", request->config);
  std::vector<std::string> names;
  for (const fleet::Job& job : fleet::jobs()) names.emplace_back(job.name);
  command->add_option("--job", request->jobs)->delimiter(',')->check(CLI::IsMember(names))->capture_default_str();
  add_number(command, "--bank", gap::kLeastNulls, gap::kMostNulls, request->bank_missions);
  add_defaulted(command, "--seed", request->bank_seed);
  command->callback([request] { with_exit_statuses([&] { make_fleet_plan(*request); }); });
}

void add_fleet_run(CLI::App& parent) {
  struct Options {
    std::string plan, tasks;
    bool again = false;
    unsigned threads = 1;
  };
  auto* command = parent.add_subcommand("run", "do tasks of a plan; those that have a result are not done again");
  const auto options = std::make_shared<Options>();
  command->add_option("PLAN", options->plan)->required();
  add_valued(command, "--task", "K", options->tasks)->required();
  add_number(command, "--threads", 1, 1024, options->threads);
  command->add_flag("--again", options->again);
  command->callback([options] {
    with_exit_statuses([&] { run_fleet_tasks(options->plan, options->tasks, options->again, options->threads); });
  });
}

void add_fleet_causes(CLI::App& parent) {
  auto* command = parent.add_subcommand("causes",
                                        "what the missions tell together: which causes belong to a vehicle, to "
                                        "the design, to a day, and when they began");
  const auto options = std::make_shared<CausesOptions>();
  command->add_option("PLAN", options->plan)->required();
  add_valued(command, "--json", "FILE|-", options->json);
  add_valued(command, "--report", "FILE.html", options->page);
  command->add_option("--threads", options->threads)->check(CLI::Range(1, 1024));
  command->callback([options] { with_exit_statuses([&] { tell_causes(*options); }); });
}

void add_fleet_merge(CLI::App& parent) {
  struct Options {
    std::string plan, output, page;
  };
  auto* command = parent.add_subcommand("merge", "all results of a plan in one SQLite file");
  const auto options = std::make_shared<Options>();
  command->add_option("PLAN", options->plan)->required();
  add_valued(command, "-o,--output", "FILE.sqlite", options->output);
  add_valued(command, "--report", "FILE.html", options->page);
  command->callback(
      [options] { with_exit_statuses([&] { merge_fleet(options->plan, options->output, options->page); }); });
}

void add_fleet_list(CLI::App& parent) {
  struct Options {
    std::string plan;
    bool json = false;
  };
  auto* command = parent.add_subcommand("list", "the tasks of a plan and their state, one a line");
  const auto options = std::make_shared<Options>();
  command->add_option("PLAN", options->plan)->required();
  command->add_flag("--json", options->json);
  command->callback([options] { with_exit_statuses([&] { list_fleet(options->plan, options->json); }); });
}

}  // namespace

void add_fleet(CLI::App& app) {
  auto* const command = app.add_subcommand(
      "fleet", "many recordings: plan, run on this machine or by Slurm, merge the results into one file");
  command->require_subcommand(1);
  add_fleet_plan(*command);
  add_fleet_submit(*command);
  add_fleet_run(*command);
  add_fleet_list(*command);
  add_fleet_merge(*command);
  add_fleet_causes(*command);
}

}  // namespace navcal::cli
