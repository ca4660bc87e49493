// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <string>
#include <vector>

#include "analysis/surfacing_run.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "config/load.h"
#include "record/recording.h"
#include "report/surfacings_report.h"

namespace navcal::cli {
namespace {

struct SurfacingsOptions {
  std::vector<std::string> files;
  std::string config, page;
  bool json = false;
};

void show_surfacings(const SurfacingsOptions& options) {
  expect_results({options.files.begin(), options.files.end()}, {options.page});
  const auto settings = options.config.empty() ? record::Recording::open(options.files.front())->settings()
                                               : config::load(options.config);
  analysis::SurfacingRun run(settings);
  std::vector<std::string> files;
  for (const auto& file : options.files)
    if (run.play(file)) files.push_back(file);
  tell_remarks("navcal log", run.remarks());
  if (!options.page.empty())
    write_result(options.page, report::surfacings_page(run.surfacings(), files, run.settings()));
  const std::string text =
      options.json ? report::surfacings_json(run.surfacings(), files) : report::surfacings_text(run.surfacings());
  std::fputs(text.c_str(), stdout);
}

}  // namespace

void add_log_surfacings(CLI::App& log) {
  const auto [command, options] = add_command<SurfacingsOptions>(
      log, "surfacings", "time to first fix and error of the dead reckoning at each surfacing of recordings",
      [](const SurfacingsOptions& given) { with_exit_statuses([&] { show_surfacings(given); }); });
  command->add_option("FILE", options->files)->required();
  command->add_flag("--json", options->json);
  add_valued(command, "--report", "FILE.html", options->page);
  add_valued(command, "--config", "FILE", options->config);
}

}  // namespace navcal::cli
