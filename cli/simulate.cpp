// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <optional>

#include "base/interruptible.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "config/load.h"
#include "devices/instrument_model.h"
#include "emulation/chosen_vehicle.h"
#include "emulation/simulate_run.h"
#include "report/simulate_page.h"
#include "sim/effects/choice.h"
#include "sim/layout/effects/layout_effects.h"
#include "sim/recording.h"

namespace navcal::cli {
namespace {

struct SimulateCommandOptions {
  emulation::SimulateArguments arguments;
  bool list_effects = false;
};

void run(const emulation::SimulateArguments& arguments) {
  sim::EffectSet effects = emulation::simulate_effects(arguments);
  const emulation::SimulatedRun run = emulation::simulate_motion(arguments, effects);
  if (!run.remark.empty()) fmt::print(stderr, "navcal simulate: {}\n", run.remark);
  std::optional<emulation::SimulateHistory> history;
  if (!arguments.report.empty())
    history.emplace(sim::recording_ports(arguments.instruments, run.commands), arguments.begin_ns, run.duration_s);
  const base::Interruptible interruptible;
  base::Progress progress("simulate");
  emulation::write_simulation(arguments, run, effects, history ? &*history : nullptr, [&progress](double share) {
    if (base::Interruptible::interrupted())
      throw base::Failure(base::Exit::failed, "interrupted: nothing was written");
    progress.show(share);
  });
  if (history) {
    write_result(arguments.report, report::simulate_page(*history, arguments, run, effects));
  }
}

void simulate(SimulateCommandOptions& options) {
  if (options.list_effects) {
    std::fputs(sim::effects_text().c_str(), stdout);
    fmt::print("\nWith a layout (--vehicle LAYOUT.toml) those on the vehicle are these, and water_current:\n\n{}",
               sim::layout_effects_text());
    return;
  }
  auto& arguments = options.arguments;
  const int given = int{!arguments.path.empty()} + int{!arguments.drive.empty()} + int{!arguments.mission.empty()};
  if (given != 1) {
    throw base::Failure(base::Exit::usage, "one of --path, --drive and --mission is required");
  }
  if (arguments.capture.empty()) throw base::Failure(base::Exit::usage, "-o FILE.cap is required: the recording");
  expect_not_ending(arguments.capture, ".mcap", "a capture (.cap)", "navcal log import makes a log of a capture");
  expect_results({arguments.path, arguments.drive, arguments.mission, arguments.vehicle, arguments.config,
                  arguments.effects_file},
                 {arguments.capture, arguments.truth, arguments.report});
  arguments.begin_ns = arguments.where.day_ns().value_or(emulation::kSimulatedBegin_ns);
  arguments.place = emulation::simulated_place(arguments.where, arguments.begin_ns);
  if (!arguments.place.remark.empty()) std::fprintf(stderr, "navcal: %s\n", arguments.place.remark.c_str());
  if (!arguments.config.empty()) arguments.instruments = devices::instrument_model(config::load(arguments.config));
  arguments.layout = emulation::layout_in(arguments.vehicle);
  run(arguments);
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto* command = app.add_subcommand("simulate", "simulates a recording and its true motion");
  const auto options = std::make_shared<SimulateCommandOptions>();
  auto& arguments = options->arguments;
  const auto* const motion = "Motion of the vehicle (one of these)";
  add_valued(command, "--path", "CSV", arguments.path)->group(motion);
  add_valued(command, "--drive", "CSV", arguments.drive)->group(motion);
  add_valued(command, "--mission", "NAME|FILE", arguments.mission)->group(motion);
  add_valued(command, "--vehicle", "FILE.toml", arguments.vehicle);
  add_valued(command, "--config", "FILE.toml", arguments.config);
  command->add_option("--seconds", arguments.seconds)->check(CLI::Range(0.01, 1e6));
  add_effect_options(command, arguments.effects, arguments.effects_file);
  add_clock_option(command, arguments.clocks);
  add_place_and_field(command, arguments.where);
  add_valued(command, "--date", "YYYY-MM-DD", arguments.where.date);
  add_defaulted(command, "--seed", arguments.seed);
  command->add_flag("--no-noise", arguments.no_noise);
  add_valued(command, "-o,--output", "FILE.cap", arguments.capture);
  add_valued(command, "--truth", "FILE.csv", arguments.truth);
  add_valued(command, "--report", "FILE.html", arguments.report);
  command->add_flag("--list-effects", options->list_effects);
  command->callback([options] { simulate(*options); });
}

}  // namespace navcal::cli
