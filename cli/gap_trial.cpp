// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/interruptible.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "config/complaints.h"
#include "gap/thresholds.h"
#include "report/validation_report.h"
#include "report/validation_words.h"
#include "validation/active_trial.h"
#include "validation/run.h"

namespace navcal::cli {
namespace {

struct GapTrialCommandOptions {
  bool active = false;
  int missions = 1;
  int cases = 0, places = validation::kTrialPlaces, timeout_s = 600;
  std::optional<double> minutes;
  std::uint64_t seed = 1;
  std::vector<std::string> arms;
  std::vector<int> only;
  std::string json;
  std::filesystem::path report;
  validation::CaseRunOptions asking;
  std::vector<std::string> layouts;
  validation::LayoutTrial on_layouts;
};

/// Reads the layouts, and checks the options that depend on whether there are any.
void complete(GapTrialCommandOptions& options) {
  const auto expect = [](bool holds, const char* what) {
    if (!holds) throw base::Failure(base::Exit::usage, what);
  };
  expect((options.cases > 0) != !options.only.empty(), "either --cases N or --only CASE is required");
  if (options.layouts.empty()) {
    options.minutes = options.minutes.value_or(10);
    return expect(*options.minutes == 3 || *options.minutes == 10, "--minutes: 3 or 10, without --layout");
  }
  validation::LayoutTrial& on = options.on_layouts;
  on.minutes = *(options.minutes = options.minutes.value_or(on.minutes));
  on.seed = options.seed;
  expect(!options.active,
         "--active with --layout: the second reality sails planned missions with the reference vehicle only");
  expect(!options.asking.bank_missions,
         "--bank with --layout: the floor of a layout is that of nominal recordings (--nominal)");
  for (const std::string& file : options.layouts)
    on.layouts.push_back({std::filesystem::path(file).filename().string(), config::content_of(file)});
}

/// Stream for text; JSON may have standard output for itself.
std::FILE* talk(const GapTrialCommandOptions& options) { return options.json == "-" ? stderr : stdout; }

void give(const GapTrialCommandOptions& options, const std::string& text, const std::string& json) {
  fmt::print(talk(options), "{}", text);
  if (options.json == "-") fmt::print("{}", json);
  if (!options.json.empty() && options.json != "-") write_result(options.json, json);
}

std::vector<validation::TrialCase> cases_of(const GapTrialCommandOptions& options) {
  const bool on_layouts = !options.layouts.empty();
  std::vector<int> numbers = options.only;
  if (numbers.empty()) {
    try {
      const validation::TrialRound round = on_layouts ? validation::layout_round() : validation::reference_round();
      numbers = validation::case_numbers(validation::trial_arms_named(options.arms, round), options.cases, round);
    } catch (const std::invalid_argument& error) {
      throw base::Failure(base::Exit::usage, std::string("--arms: ") + error.what());
    }
  }
  std::vector<validation::TrialCase> cases;
  with_exit_statuses(
      [&] {
        base::Progress progress("gap trial: cases");
        if (on_layouts)
          cases = validation::drawn_layout_cases(options.on_layouts, numbers,
                                                 [&](double done) { progress.show(done); });
      },
      base::Exit::bad_input);
  if (on_layouts) return cases;
  for (const int number : numbers)
    cases.push_back(validation::drawn_case(options.seed, number, *options.minutes, options.places));
  return cases;
}

report::TrialReport report_on(const GapTrialCommandOptions& options, std::size_t asked_for,
                              validation::TrialRun run) {
  report::TrialReport report{options.seed,
                             *options.minutes,
                             options.places,
                             asked_for,
                             std::move(run.ended_early),
                             std::move(run.results),
                             {},
                             {},
                             options.on_layouts};
  report.scores = validation::trial_scores(report.results);
  report.confusion = validation::trial_confusion(report.results);
  return report;
}

/// Commitments to the truths of these cases, which are printed first.
std::vector<validation::Commitment> sealed(const std::vector<validation::TrialCase>& cases, std::uint64_t seed,
                                           std::FILE* out) {
  fmt::print(out,
             "Commitment: SHA-256 of each case's truth and salt, which are published after the last answer.\n");
  std::vector<validation::Commitment> seals;
  for (const validation::TrialCase& drawn : cases) {
    seals.push_back(validation::commitment_to(validation::truth_text(drawn, seed)));
    fmt::print(out, "case {:4} {}\n", drawn.number, seals.back().digest);
  }
  std::fflush(out);
  return seals;
}

/// The trial in which each answer is followed by the mission that is planned for it.
void run_active_trial(const GapTrialCommandOptions& options) {
  const base::Interruptible interruptible;
  const std::vector<validation::TrialCase> cases = cases_of(options);
  const std::vector<validation::Commitment> seals = sealed(cases, options.seed, talk(options));
  validation::ActiveOptions active;
  active.program = options.asking.program;
  active.missions = options.missions;
  active.minutes = static_cast<int>(*options.minutes);
  active.bank_missions = options.asking.bank_missions;
  active.timeout = std::chrono::seconds(options.timeout_s);
  std::vector<validation::ActiveResult> results;
  {
    base::Progress progress("gap trial --active");
    for (std::size_t i = 0; i < cases.size() && !base::Interruptible::interrupted(); ++i) {
      if (auto result = validation::run_active(cases[i], seals[i], options.seed, active))
        results.push_back(std::move(*result));
      progress.show(static_cast<double>(i + 1) / static_cast<double>(cases.size()));
    }
  }
  give(options, validation::active_text(results), validation::active_json(results, options.seed));
  if (results.size() < cases.size()) {
    throw base::Failure(base::Exit::failed,
                        fmt::format("interrupted: {} of {} cases are scored", results.size(), cases.size()));
  }
}

void run(GapTrialCommandOptions options) {
  complete(options);
  // Hours later is too late to learn that a file cannot be written.
  expect_results({options.layouts.begin(), options.layouts.end()}, {options.json, options.report});
  if (!options.asking.keep.empty()) std::filesystem::create_directories(options.asking.keep);
  if (options.active) return run_active_trial(options);
  options.asking.timeout = std::chrono::seconds(options.timeout_s);
  const base::Interruptible interruptible;
  const std::vector<validation::TrialCase> cases = cases_of(options);
  std::FILE* const out = talk(options);
  const std::vector<validation::Commitment> seals = sealed(cases, options.seed, out);

  validation::TrialRun answered;
  {
    base::Progress progress("gap trial");
    std::size_t done = 0;
    answered = validation::ask_all(cases, seals, options.asking, [&](const validation::TrialResult& result) {
      fmt::print(out, "case {:4} answered in {:.1f} s: {}\n", result.drawn.number, result.seconds,
                 report::answer_words(result));
      std::fflush(out);
      progress.show(static_cast<double>(++done) / static_cast<double>(cases.size()));
    });
  }
  const report::TrialReport report = report_on(options, cases.size(), std::move(answered));
  give(options, report::trial_text(report), report::trial_json(report));
  if (!options.report.empty()) write_result(options.report, report::trial_page(report));
  if (!options.asking.keep.empty()) {
    for (const validation::TrialResult& result : report.results)
      write_result(options.asking.keep / fmt::format("{:04}", result.drawn.number) / "truth.json",
                   result.seal.truth + '\n');
  }
  if (!report.ended_early.empty()) {
    throw base::Failure(base::Exit::failed, fmt::format("{}: {} of {} cases are scored", report.ended_early,
                                                        report.results.size(), report.asked_for));
  }
}

}  // namespace

void add_gap_trial(CLI::App& gap) {
  const auto [command, options] =
      add_command<GapTrialCommandOptions>(gap, "trial", "blind validation of the diagnosis on withheld effects",
                                          [](const GapTrialCommandOptions& given) { run(given); });
  auto& asking = options->asking;
  add_valued(command, "--cases", "N", options->cases)->check(CLI::Range(1, 100000));
  command->add_flag("--active", options->active);
  add_number(command, "--missions", 1, validation::kMostPlannedMissions, options->missions);
  add_defaulted(command, "--seed", options->seed);
  add_valued(command, "--minutes", "M", options->minutes)->check(CLI::Range(0.75, 60.0));
  add_number(command, "--places", 1, 100000, options->places);
  auto& on = options->on_layouts;
  add_repeatable(command, "--layout", "FILE.toml", options->layouts)->excludes("--places");
  add_number(command, "--vehicles", 1, 1000, on.vehicles)->needs("--layout");
  add_number(command, "--nominal", 1, 100, on.nominal)->needs("--layout");
  add_number(command, "--layout-error", 0.0, 0.2, on.layout_error)->needs("--layout");
  add_number(command, "--unmodelled", 0.0, 10.0, on.unmodelled)->needs("--layout");
  add_valued(command, "--arms", "LIST", options->arms)->delimiter(',');
  add_valued(command, "--only", "CASE", options->only)->delimiter(',')->check(CLI::PositiveNumber);
  add_number(command, "--jobs", 1, 256, asking.jobs);
  add_valued(command, "--bank", "N", asking.bank_missions)->check(CLI::Range(gap::kLeastNulls, gap::kMostNulls));
  add_valued(command, "--without", "LIST", asking.without)->delimiter(',');
  add_number(command, "--timeout", 1, 86400, options->timeout_s);
  add_valued(command, "--json", "FILE|-", options->json);
  add_valued(command, "--report", "FILE.html", options->report);
  add_valued(command, "--keep", "DIR", asking.keep);
  command->add_option("--program", asking.program)->group("");
}

}  // namespace navcal::cli
