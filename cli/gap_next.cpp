// SPDX-License-Identifier: Apache-2.0
#include "cli/gap_next.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "analysis/chosen_vehicle.h"
#include "analysis/output.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "cli/commands.h"
#include "cli/result_file.h"
#include "config/load.h"
#include "config/mission_limits.h"
#include "config/mission_text.h"
#include "gap/design/next_mission.h"
#include "gap/verdict/study.h"
#include "record/recording.h"
#include "report/next_mission.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::cli {
namespace {

struct GapNextOptions {
  report::NextMissionSource source;
  std::vector<std::string> excluded;
  std::string config, json, report;
  std::filesystem::path cache;
  std::optional<double> minutes;
  bool overwrite = false;
  bool list_limits = false;
  int bank_missions = gap::Request{}.bank_missions;
  std::uint64_t bank_seed = gap::Request{}.bank_seed;
};

config::MissionLimits limits_of(const GapNextOptions& options) {
  config::MissionLimits limits;
  if (!options.source.limits.empty()) limits = config::load_mission_limits(options.source.limits);
  if (options.minutes) limits.duration_s = 60 * *options.minutes;
  return limits;
}

gap::Request request_of(const GapNextOptions& options) {
  gap::Request request;
  if (!options.source.vehicle.empty()) {
    const analysis::ChosenVehicle vehicle = analysis::load_chosen_vehicle(options.source.vehicle);
    if (std::holds_alternative<config::Layout>(vehicle))
      throw std::invalid_argument("--vehicle: missions are planned for vehicle files only, not for layouts");
    request.vehicle = std::get<config::VehicleSettings>(vehicle);
  }
  for (const std::string& name : options.excluded) {
    if (!sim::make_effect(name))
      throw std::invalid_argument("--exclude " + name + ": " + sim::unknown_effect(name));
  }
  const auto& recordings = options.source.recordings;
  request.mission = recordings.front();
  request.holdouts.assign(recordings.begin() + 1, recordings.end());
  request.holdouts.insert(request.holdouts.end(), options.source.holdouts.begin(), options.source.holdouts.end());
  if (!options.config.empty()) request.settings = config::load(options.config);
  request.excluded = options.excluded;
  request.cache = options.cache;
  request.bank_missions = options.bank_missions;
  request.bank_seed = options.bank_seed;
  return request;
}

/// Checks before the work that the results can be written. Throws Failure.
void expect_writable(const GapNextOptions& options) {
  const auto& source = options.source;
  std::error_code error;
  if (!options.overwrite && std::filesystem::exists(source.mission, error)) {
    throw analysis::Failure(analysis::Exit::usage,
                            source.mission + ": this mission is there already; --overwrite replaces it");
  }
  for (const std::string& file : {source.mission, options.json, options.report}) {
    if (!file.empty() && file != "-") expect_folder_of(file);
  }
  std::vector<std::filesystem::path> inputs(source.recordings.begin(), source.recordings.end());
  inputs.insert(inputs.end(), source.holdouts.begin(), source.holdouts.end());
  inputs.insert(inputs.end(), {source.vehicle, source.limits, options.config});
  expect_no_overwriting(inputs, {source.mission, options.json, options.report});
}

void write_plan(const gap::NextMission& next, const GapNextOptions& options) {
  const auto& source = options.source;
  write_result(source.mission, config::mission_text(next.mission, report::next_mission_head(next)));
  if (!options.report.empty()) write_result(options.report, report::next_mission_page(next, source));
  const std::string json = options.json.empty() ? "" : report::next_mission_json(next, source) + '\n';
  if (!options.json.empty() && options.json != "-") write_result(options.json, json);
  analysis::Output output(STDOUT_FILENO, "standard output");
  output.append(options.json == "-" ? json : report::next_mission_text(next, source));
  output.flush();
}

void plan_next(const GapNextOptions& options) {
  try {
    const config::MissionLimits limits = limits_of(options);
    expect_writable(options);
    const base::Interruptible interruptible;
    analysis::Progress progress("gap next", analysis::Progress::Answer::at_the_end);
    const gap::Progress show = [&](std::string_view what, double done) {
      if (base::Interruptible::interrupted())
        throw analysis::Failure(analysis::Exit::failed, "interrupted: nothing was written");
      progress.show(what, done);
    };
    const auto study = gap::study(request_of(options), show);
    write_plan(gap::plan_next_mission(*study, limits, show), options);
  } catch (const record::BadRecording& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    throw analysis::Failure(analysis::Exit::usage, error.what());
  } catch (const std::system_error& error) {
    throw analysis::Failure(analysis::Exit::failed, error.what());
  }
}

}  // namespace

void add_gap_next(CLI::App& gap, const std::filesystem::path& usual_cache) {
  auto* command = gap.add_subcommand("next", "plans the mission that tells best what a diagnosis leaves open");
  const auto options = std::make_shared<GapNextOptions>();
  options->cache = usual_cache;
  auto& source = options->source;
  command
      ->add_option("FILE", source.recordings,
                   "the recording to be diagnosed, then others of the same vehicle: captures or logs")
      ->option_text("FILE...");
  command->add_option("--holdout", source.holdouts, "another mission of the same vehicle; repeatable")
      ->option_text("FILE")
      ->allow_extra_args(false);
  command->add_option("--minutes", options->minutes, "longest duration of the mission; default: 10")
      ->check(CLI::Range(1.0, 120.0));
  command->add_option("--limits", source.limits, "limits of depth, range, speed, rate of turn and energy")
      ->option_text("FILE.toml");
  command->add_flag("--list-limits", options->list_limits, "prints a file of limits with the defaults");
  command->add_option("--mission-out", source.mission, "the mission, for navcal simulate, emulate and pilot")
      ->option_text("FILE.toml");
  command->add_flag("--overwrite", options->overwrite, "replaces a mission file that is there already");
  command->add_option("--json", options->json, "the plan as one JSON object; - is standard output, without text")
      ->option_text("FILE|-");
  command->add_option("--report", options->report, "page with pictures; needs no other file")
      ->option_text("FILE.html");
  command->add_option("--vehicle", source.vehicle, "the nominal vehicle, if it is not the reference vehicle")
      ->option_text("FILE.toml");
  command->add_option("--config", options->config, "configuration of all recordings, instead of their own")
      ->option_text("FILE.toml");
  command->add_option("--exclude", options->excluded, "removes this effect from the library; repeatable")
      ->option_text("NAME")
      ->allow_extra_args(false);
  command->add_option("--bank", options->bank_missions, "number of simulated nominal missions")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  command->add_option("--seed", options->bank_seed, "seed of their noise and tolerances")->capture_default_str();
  command->add_option("--cache", options->cache, "folder in which they are kept")->option_text("DIR");
  command->footer(
      "The exit status is 0 also when no mission within the limits would decide.\n\n"
      "Example: navcal gap next a.cap --holdout b.cap --minutes 8 --mission-out next.toml --report next.html");
  command->callback([options] {
    if (options->list_limits) {
      std::fputs(config::mission_limits_file({}).c_str(), stdout);
      return;
    }
    if (options->source.recordings.empty()) throw CLI::RequiredError("FILE");
    if (options->source.mission.empty()) throw CLI::RequiredError("--mission-out");
    plan_next(*options);
  });
}

}  // namespace navcal::cli
