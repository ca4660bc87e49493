// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "cli/recorded_motions.h"
#include "config/layout/layout_file.h"
#include "config/load.h"
#include "identify/answer/identification.h"
#include "report/identify_report.h"

namespace navcal::cli {
namespace {

struct IdentifyCommandOptions : WindowOptions {
  std::string vehicle, output, json, report, config;
  std::vector<std::string> files, held_out;
  bool no_advice = false, force = false;
};

identify::Identification identification_of(const IdentifyCommandOptions& options) {
  const record::TimeWindow window = options.window();
  identify::IdentifyRequest request;
  request.prior = config::load_layout(options.vehicle);
  std::optional<config::Settings> settings;
  if (!options.config.empty()) settings = config::load(options.config);
  request.advise = !options.no_advice;
  base::Progress progress("identify", base::Progress::Answer::at_the_end);
  record::SeenRecordings seen;
  request.recordings = load_motions(options.files, settings, progress, seen, window);
  request.held_out = load_motions(options.held_out, settings, progress, seen, window);
  return identify::identify(request, [&](std::string_view what, double done) { progress.show(what, done); });
}

void write_identification(const IdentifyCommandOptions& options, const identify::Identification& found) {
  tell_remarks("navcal", found.warnings);
  if (found.worse.empty() || options.force) write_result(options.output, config::layout_file(found.layout));
  if (!options.report.empty()) write_result(options.report, report::identify_page(found));
  give_answer(options.json, options.json.empty() ? std::string() : report::identify_json(found),
              report::identify_text(found));
  if (!found.worse.empty() && !options.force)
    throw base::Failure(base::Exit::failed,
                        fmt::format("{} is not written: on the held-out recordings {}; --force writes it",
                                    options.output, found.worse));
}

void run_identify(const IdentifyCommandOptions& options) {
  expect_results(all_paths({options.files, options.held_out}, {options.vehicle, options.config}),
                 {options.output, options.json, options.report});
  with_exit_statuses([&] { write_identification(options, identification_of(options)); }, base::Exit::bad_input);
}

}  // namespace

void add_identify(CLI::App& app) {
  const auto [command, options] = add_command<IdentifyCommandOptions>(
      app, "identify",
      "parameters of a vehicle's layout, with standard errors, from recordings and their commands", run_identify);
  command->add_option("FILE", options->files)->required();
  add_valued(command, "--vehicle", "PRIOR.toml", options->vehicle)->required();
  add_repeatable(command, "--holdout", "FILE", options->held_out);
  add_valued(command, "-o,--output", "VEHICLE.toml", options->output)->required();
  add_valued(command, "--json", "FILE|-", options->json);
  add_valued(command, "--report", "FILE.html", options->report);
  add_valued(command, "--config", "FILE.toml", options->config);
  add_window(*command, *options);
  command->add_flag("--no-advice", options->no_advice);
  command->add_flag("--force", options->force);
}

}  // namespace navcal::cli
