// SPDX-License-Identifier: Apache-2.0
#include "cli/gap_next.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <system_error>

#include "analysis/failure.h"
#include "analysis/output.h"
#include "analysis/progress.h"
#include "base/interruptible.h"
#include "cli/gap_request.h"
#include "cli/result_file.h"
#include "config/error.h"
#include "config/mission_limits.h"
#include "gap/design/mission_design.h"
#include "record/recording.h"
#include "report/next_mission_report.h"

namespace navcal::cli {
namespace {

struct GapNextOptions : GapRequestOptions {
  std::optional<double> minutes;
  std::string limits, mission, json, report;
  bool overwrite = false;
};

config::MissionLimits limits_of(const GapNextOptions& options) {
  config::MissionLimits limits;
  if (!options.limits.empty()) limits = config::load_mission_limits(options.limits);
  if (options.minutes) limits.duration_s = 60 * *options.minutes;
  return limits;
}

void expect_next_outputs(const GapNextOptions& options) {
  std::vector<std::filesystem::path> inputs(options.source.missions.begin(), options.source.missions.end());
  inputs.insert(inputs.end(), options.source.holdouts.begin(), options.source.holdouts.end());
  inputs.insert(inputs.end(), {options.source.vehicle, options.source.config, options.limits});
  expect_no_overwriting(inputs, {options.mission, options.json, options.report});
  for (const std::string& file : {options.mission, options.json, options.report}) {
    if (!file.empty() && file != "-") expect_folder_of(file);
  }
  if (!options.overwrite && std::filesystem::exists(options.mission)) {
    throw analysis::Failure(analysis::Exit::failed, options.mission + " exists already (--overwrite replaces it)");
  }
}

void plan_next(const GapNextOptions& options) {
  try {
    expect_instruments(options.without);
    expect_next_outputs(options);
    const config::MissionLimits limits = limits_of(options);
    if (layout_of(options)) {
      throw analysis::Failure(analysis::Exit::usage,
                              "--vehicle: a mission cannot be planned for a layout yet, only for a vehicle file");
    }
    const base::Interruptible interruptible;
    gap::NextMission next;
    {
      analysis::Progress progress("gap next", analysis::Progress::Answer::at_the_end);
      next = gap::next_mission(gap_request_of(options), limits, [&](std::string_view what, double done) {
        if (base::Interruptible::interrupted()) throw analysis::Failure(analysis::Exit::failed, "interrupted");
        progress.show(what, done);
      });
    }
    if (next.toml.empty()) throw analysis::Failure(analysis::Exit::bad_input, next.sentence);
    write_result(options.mission, next.toml);
    const std::string json = report::next_mission_json(next, options.mission) + "\n";
    if (!options.report.empty()) write_result(options.report, report::next_mission_page(next, options.mission));
    if (!options.json.empty() && options.json != "-") write_result(options.json, json);
    analysis::Output output(STDOUT_FILENO, "standard output");
    output.append(options.json == "-" ? json : report::next_mission_text(next, options.mission));
    output.flush();
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

void add_gap_next(CLI::App& gap) {
  auto* command =
      gap.add_subcommand("next", "plans the mission that is expected to decide what the recordings leave open");
  const auto options = std::make_shared<GapNextOptions>();
  add_gap_request(*command, *options)->required();
  command->add_option("--minutes", options->minutes, "length of the mission; default: 3, or that of --limits")
      ->check(CLI::Range(0.5, 120.0))
      ->option_text("M");
  command
      ->add_option("--limits", options->limits,
                   "bounds of the mission: minutes, least_depth_m, greatest_depth_m, radius_m, least_shaft_rpm, "
                   "greatest_shaft_rpm, greatest_turn_rate_deg_s, greatest_pitch_deg, energy_Wh, battery_V")
      ->option_text("FILE.toml");
  command
      ->add_option("--mission-out", options->mission, "the mission file, for navcal simulate, emulate and pilot")
      ->option_text("FILE.toml")
      ->required();
  command->add_option("--json", options->json, "the plan as one JSON object; - is standard output, without text")
      ->option_text("FILE|-");
  command->add_option("--report", options->report, "page with pictures; needs no other file")
      ->option_text("FILE.html");
  command->add_flag("--overwrite", options->overwrite, "replaces a mission file that exists");
  command->footer(
      "The exit status is 0 also when no mission within the limits is expected to decide.\n\n"
      "Example:\n"
      "  navcal gap next a.cap --holdout b.cap --minutes 3 --mission-out next.toml\n"
      "  navcal pilot next.toml");
  command->callback([options] { plan_next(*options); });
}

}  // namespace navcal::cli
