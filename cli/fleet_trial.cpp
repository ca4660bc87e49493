// SPDX-License-Identifier: Apache-2.0
#include "validation/fleet_trial.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"

namespace navcal::cli {
namespace {

struct FleetTrialArguments {
  validation::FleetTrialOptions options;
  std::string folder, truth, answer;
};

void record_fleet(const FleetTrialArguments& arguments) {
  expect_folder_of(arguments.truth);
  const validation::FleetCase fleet = validation::drawn_fleet(arguments.options);
  with_exit_statuses([&] {
    const base::Interruptible interruptible;
    base::Progress progress("fleet trial record");
    validation::write_fleet(fleet, arguments.folder, base::threads_or_cores(),
                            [&](double done) { progress.show(done); });
    write_result(arguments.truth, validation::truth_text(fleet));
  });
  fmt::print("{} missions of {} vehicles in {}, truth in {}\n",
             arguments.options.vehicles * arguments.options.days, arguments.options.vehicles, arguments.folder,
             arguments.truth);
}

void score_fleet(const FleetTrialArguments& arguments) {
  const auto named = [](const std::string& file, const auto& read) {
    try {
      return read(read_file(file));
    } catch (const std::runtime_error& error) {
      throw base::Failure(base::Exit::bad_input, file + ": " + error.what());
    }
  };
  const validation::FleetTruth truth = named(arguments.truth, validation::read_fleet_truth);
  fmt::print("{}", validation::score_text(named(arguments.answer, [&](const std::string& text) {
               return validation::score_of(truth, text);
             })));
}

}  // namespace

void add_fleet_trial(CLI::App& parent) {
  auto* trial =
      parent.add_subcommand("trial", "a fleet with sealed causes from the reference simulator, and its score");
  trial->require_subcommand(1);
  trial->footer(
      "Example:\n"
      "  navcal research fleet-trial record -o recordings/ --truth truth.json\n"
      "  navcal research fleet-trial score answer.json --truth truth.json");
  const auto arguments = std::make_shared<FleetTrialArguments>();
  validation::FleetTrialOptions& options = arguments->options;

  auto* record = trial->add_subcommand("record", "missions of a fleet, with the truth apart");
  add_valued(record, "-o,--output", "DIR", arguments->folder, "folder for the missions; a new or an empty one")
      ->required();
  add_valued(record, "--truth", "FILE.json", arguments->truth, "file for the truth")->required();
  add_defaulted(record, "--seed", options.seed, "seed of vehicles, causes, days and noise");
  add_number(record, "--vehicles", 1, 99, options.vehicles, "number of vehicles");
  add_number(record, "--days", 1, 99, options.days, "number of days; each vehicle sails one mission on each");
  record->add_option("--minutes", options.minutes, "length of a mission: 3 or 10")
      ->check(CLI::IsMember({3, 10}))
      ->capture_default_str();
  add_number(record, "--strength", 0.0, 5.0, options.strength, "strength of the causes, typical values");
  add_number(record, "--weak", 0.0, 5.0, options.weak, "strength of the weak cause of the design; 0: none");
  record->footer("Example: navcal research fleet-trial record -o recordings/ --truth truth.json --seed 7");
  record->callback([arguments] { record_fleet(*arguments); });

  auto* score = trial->add_subcommand("score", "compares what navcal fleet causes --json wrote with the truth");
  score->add_option("ANSWER", arguments->answer, "file of navcal fleet causes --json")->required();
  add_valued(score, "--truth", "FILE.json", arguments->truth, "the truth that was written with the missions")
      ->required();
  score->footer("Example: navcal research fleet-trial score answer.json --truth truth.json");
  score->callback([arguments] { score_fleet(*arguments); });
}

}  // namespace navcal::cli
