// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/calibrate_run.h"
#include "analysis/progress.h"
#include "cli/commands.h"
#include "cli/exit_statuses.h"
#include "cli/result_file.h"
#include "cli/shared_options.h"
#include "config/load.h"
#include "record/json/calibration_json.h"
#include "report/calibrate_report.h"

namespace navcal::cli {
namespace {

struct CalibrateCommandOptions : WindowOptions {
  std::vector<std::string> files;
  std::string config, report;
  bool json = false;
};

void calibrate(const CalibrateCommandOptions& options) {
  const record::TimeWindow window = options.window();
  std::vector<std::filesystem::path> inputs(options.files.begin(), options.files.end());
  inputs.emplace_back(options.config);
  expect_results(inputs, {options.report});
  const auto settings = options.config.empty() ? record::Recording::open(options.files.front())->settings()
                                               : config::load(options.config);
  std::optional<analysis::CalibrateHistory> history;
  if (!options.report.empty()) history.emplace(settings);
  analysis::CalibrateRun run(settings, history ? &*history : nullptr);
  for (const std::string& file : options.files) {
    analysis::Progress progress("calibrate");
    run.play(
        file, [&progress](double share) { progress.show(share); }, window);
  }
  const calib::Report report = run.finish();
  tell_remarks("navcal", run.remarks());

  std::string answer;
  if (options.json) {
    record::append_calibrate_json(answer, report);
    answer += '\n';
  } else {
    answer = report::calibrate_text(report, run.duration_s());
  }
  print_answer(answer);
  if (history) {
    const report::PageSource source{options.files, options.config, run.settings(), run.duration_s(),
                                    run.remarks()};
    write_result(options.report, report::calibrate_page(report, *history, source));
  }
}

}  // namespace

void add_calibrate(CLI::App& app) {
  auto options = std::make_shared<CalibrateCommandOptions>();
  auto* command =
      app.add_subcommand("calibrate", "calibrations of compass and gyros from recordings, with standard errors");
  command
      ->add_option("FILE", options->files,
                   "logs (.mcap) or captures (.cap) in order of time; one series, or several recordings")
      ->required();
  command->add_option("--config", options->config, "configuration to use instead of the recording's own");
  add_window(*command, *options);
  command->add_flag("--json", options->json, "one JSON object instead of text");
  add_valued(command, "--report", "FILE.html", options->report,
             "page to write, with pictures; needs no other file");
  command->footer("Example: navcal calibrate --report dive.html dive.mcap");
  command->callback([options] { calibrate(*options); });
}

}  // namespace navcal::cli
