// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "base/parallel.h"
#include "bench/fleet_trial/fleet_trial.h"

namespace navcal::bench {
namespace {

struct FleetTrialArguments {
  FleetTrialOptions options;
  std::string folder, truth, answer;
};

void record_fleet(const FleetTrialArguments& arguments) {
  const auto expect = [&](bool is_good) {
    if (!is_good) throw std::runtime_error(arguments.truth + ": cannot be written");
  };
  expect(std::ofstream(arguments.truth, std::ios::app).good());  // before the work
  const FleetCase fleet = drawn_fleet(arguments.options);
  write_fleet(fleet, arguments.folder, base::threads_or_cores(),
              [](double done) { fmt::print(stderr, "\r{:.0f} %", 100 * done); });
  expect((std::ofstream(arguments.truth) << truth_text(fleet) << std::flush).good());
  fmt::print("\n{} missions of {} vehicles in {}, truth in {}\n",
             arguments.options.vehicles * arguments.options.days, arguments.options.vehicles, arguments.folder,
             arguments.truth);
}

std::string content_of(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace
}  // namespace navcal::bench

int main(int argc, char** argv) {
  using namespace navcal::bench;
  FleetTrialArguments arguments;
  FleetTrialOptions& options = arguments.options;
  CLI::App app{"A fleet with sealed causes from the reference simulator, and the score of an answer."};
  app.require_subcommand(1);

  auto* const record = app.add_subcommand("record", "missions of a fleet, with the truth apart");
  record->add_option("-o,--output", arguments.folder, "folder for the missions; a new or an empty one")
      ->required();
  record->add_option("--truth", arguments.truth, "file for the truth")->required();
  record->add_option("--seed", options.seed, "seed of vehicles, causes, days and noise")->capture_default_str();
  record->add_option("--vehicles", options.vehicles, "number of vehicles")->check(CLI::Range(1, 99));
  record->add_option("--days", options.days, "number of days; each vehicle sails one mission on each")
      ->check(CLI::Range(1, 99));
  record->add_option("--minutes", options.minutes, "length of a mission: 3 or 10")->check(CLI::IsMember({3, 10}));
  record->add_option("--strength", options.strength, "strength of the causes, typical values")
      ->check(CLI::Range(0.0, 5.0));
  record->add_option("--weak", options.weak, "strength of the weak cause of the design; 0: none")
      ->check(CLI::Range(0.0, 5.0));
  record->footer("Example: bench_fleet_trial record -o recordings/ --truth truth.json --seed 7");
  record->callback([&] { record_fleet(arguments); });

  auto* const score = app.add_subcommand("score", "compares what navcal fleet causes --json wrote with the truth");
  score->add_option("ANSWER", arguments.answer, "file of navcal fleet causes --json")->required();
  score->add_option("--truth", arguments.truth, "the truth that was written with the missions")->required();
  score->footer("Example: bench_fleet_trial score answer.json --truth truth.json");
  score->callback([&] {
    const FleetTruth truth = read_fleet_truth(content_of(arguments.truth));
    fmt::print("{}", score_text(score_of(truth, content_of(arguments.answer))));
  });
  try {
    CLI11_PARSE(app, argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
