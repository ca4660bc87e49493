// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.h"
#include "base/interruptible.h"
#include "base/progress.h"
#include "cli/gap_request.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "config/mission_limits.h"
#include "config/mission_text.h"
#include "diagnosis/next_layout_mission.h"
#include "emulation/chosen_vehicle.h"
#include "gap/design/next_mission.h"
#include "gap/verdict/study.h"
#include "report/next_mission.h"

namespace navcal::cli {
namespace {

struct GapNextOptions {
  GapRequestOptions asked;
  std::vector<std::string> nominals;
  std::string limits, mission, json, report;
  std::optional<double> minutes;
  bool overwrite = false;
  bool list_limits = false;

  [[nodiscard]] report::NextMissionSource source() const {
    return {asked.source.missions, asked.source.holdouts, nominals, asked.source.vehicle, limits, mission};
  }
};

config::MissionLimits limits_of(const GapNextOptions& options) {
  config::MissionLimits limits;
  if (!options.limits.empty()) limits = config::load_mission_limits(options.limits);
  if (options.minutes) limits.duration_s = 60 * *options.minutes;
  return limits;
}

/// Checks before the work that the results can be written. Throws Failure.
void expect_writable(const GapNextOptions& options) {
  std::error_code error;
  if (!options.overwrite && std::filesystem::exists(options.mission, error)) {
    throw base::Failure(base::Exit::usage,
                        options.mission + ": this mission is there already; --overwrite replaces it");
  }
  const report::GapSource& asked = options.asked.source;
  expect_results(
      all_paths({asked.missions, asked.holdouts, options.nominals}, {asked.vehicle, asked.config, options.limits}),
      {options.mission, options.json, options.report});
}

void write_plan(const gap::NextMission& next, const GapNextOptions& options) {
  const report::NextMissionSource source = options.source();
  write_result(options.mission, config::mission_text(next.mission, report::next_mission_head(next)));
  if (!options.report.empty()) write_result(options.report, report::next_mission_page(next, source));
  const std::string json = options.json.empty() ? "" : report::next_mission_json(next, source) + '\n';
  give_answer(options.json, json, report::next_mission_text(next, source));
}

void plan_next(const GapNextOptions& options) {
  const config::MissionLimits limits = limits_of(options);
  expect_writable(options);
  const auto layout = emulation::layout_to_diagnose(options.asked.source.vehicle, !options.nominals.empty());
  const base::Interruptible interruptible;
  base::Progress progress("gap next", base::Progress::Answer::at_the_end);
  const gap::Progress show = [&](std::string_view what, double done) {
    if (base::Interruptible::interrupted())
      throw base::Failure(base::Exit::failed, "interrupted: nothing was written");
    progress.show(what, done);
  };
  const gap::Request request = gap_request_of(options.asked, layout.has_value());
  if (layout) {
    const auto study = diagnosis::study(request, {.layout = *layout, .excluded = {}},
                                        {options.nominals.begin(), options.nominals.end()}, show);
    write_plan(diagnosis::plan_next_mission(*study, limits, show), options);
  } else {
    write_plan(gap::plan_next_mission(*gap::study(request, show), limits, show), options);
  }
}

}  // namespace

void add_gap_next(CLI::App& gap) {
  auto* command = gap.add_subcommand("next", "plans the mission that tells best what a diagnosis leaves open");
  const auto options = std::make_shared<GapNextOptions>();
  add_gap_request(*command, options->asked);
  add_repeatable(command, "--nominal", "FILE", options->nominals);
  command->add_option("--minutes", options->minutes)->check(CLI::Range(1.0, 120.0));
  add_valued(command, "--limits", "FILE.toml", options->limits);
  command->add_flag("--list-limits", options->list_limits);
  add_valued(command, "--mission-out", "FILE.toml", options->mission);
  command->add_flag("--overwrite", options->overwrite);
  add_valued(command, "--json", "FILE|-", options->json);
  add_valued(command, "--report", "FILE.html", options->report);
  command->callback([options] {
    if (options->list_limits) {
      std::fputs(config::mission_limits_file({}).c_str(), stdout);
      return;
    }
    if (options->asked.source.missions.empty()) throw CLI::RequiredError("FILE");
    if (options->mission.empty()) throw CLI::RequiredError("--mission-out");
    with_exit_statuses([&] { plan_next(*options); });
  });
}

}  // namespace navcal::cli
