// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/next_use.h"
#include "base/failure.h"
#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "cli/live/shared_options.h"
#include "config/load.h"
#include "record/json/calibration_json.h"
#include "report/autopilot_parameters.h"
#include "report/calibrate_report.h"

namespace navcal::cli {
namespace {

struct CalibrateCommandOptions : WindowOptions {
  std::vector<std::string> files;
  std::string config, report, parameters;
  bool json = false;
};

/// "compass2" is the second; a port of MAVLink says which it reads.
int compass_unit(const config::Settings& settings, const std::string& port) {
  const auto found = std::ranges::find(settings.ports, port, &config::PortSettings::name);
  if (found != settings.ports.end() && found->protocol == protocols::Protocol::mavlink)
    return found->inertial_unit;
  return port.ends_with('2') ? 2 : port.ends_with('3') ? 3 : 1;
}

void write_parameters(const std::string& file, const calib::Report& report, const analysis::CalibrateRun& run) {
  const auto refuse = [&](std::string_view why) {
    throw base::Failure(base::Exit::failed, fmt::format("{} was not written: {}", file, why));
  };
  if (run.has_corrected_fields())
    refuse("the autopilot's own calibration is still in the fields, and its parameters replace that one");
  try {
    const bool is_px4 = run.is_of_px4() || file.ends_with(".params");
    write_result(file,
                 report::autopilot_parameters(report, compass_unit(run.settings(), run.field_port()), is_px4));
  } catch (const std::invalid_argument& error) {
    refuse(error.what());
  }
}

void calibrate(const CalibrateCommandOptions& options) {
  const record::TimeWindow window = options.window();
  expect_results(all_paths({options.files}, {options.config}), {options.report, options.parameters});
  const auto settings = options.config.empty() ? record::Recording::open(options.files.front())->settings()
                                               : config::load(options.config);
  std::optional<analysis::CalibrateHistory> history;
  if (!options.report.empty()) history.emplace(settings);
  analysis::CalibrateRun run(settings, history ? &*history : nullptr);
  std::size_t outside = 0;
  for (const std::string& file : options.files) {
    base::Progress progress("calibrate");
    try {
      run.play(
          file, [&progress](double share) { progress.show(share); }, window);
    } catch (const record::NothingInWindow&) {  // of a series, some files may lie outside
      if (++outside == options.files.size()) throw;
    }
  }
  calib::Report report = run.finish();
  base::Progress progress("calibrate, each part alone");
  analysis::add_next_use(report, run, window, [&progress](double share) { progress.show(share); });
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
  if (!options.parameters.empty()) write_parameters(options.parameters, report, run);
}

}  // namespace

void add_calibrate(CLI::App& app) {
  auto options = std::make_shared<CalibrateCommandOptions>();
  auto* command =
      app.add_subcommand("calibrate", "calibrations of compass and gyros from recordings, with standard errors");
  command->add_option("FILE", options->files)->required();
  command->add_option("--config", options->config);
  add_window(*command, *options);
  command->add_flag("--json", options->json);
  add_valued(command, "--report", "FILE.html", options->report);
  add_valued(command, "--parameters", "FILE.param", options->parameters);
  command->callback([options] {
    if (options->json && options->files.front() == "-")
      options->files.erase(options->files.begin());  // as elsewhere
    if (options->files.empty()) throw CLI::RequiredError("FILE");
    if (options->json && options->files.front().ends_with(".json"))
      throw CLI::ValidationError("--json: it takes no file here, and writes to standard output");
    calibrate(*options);
  });
}

}  // namespace navcal::cli
