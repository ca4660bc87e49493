// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "analysis/noise/noise_run.h"
#include "analysis/noise/noise_settings.h"
#include "cli/live/commands.h"
#include "cli/live/result_file.h"
#include "config/load.h"
#include "record/recording.h"
#include "report/noise_report.h"

namespace navcal::cli {
namespace {

struct NoiseCommandOptions {
  analysis::NoiseRequest request;
  std::string config, page, write;
  bool json = false;
};

void write_configuration(const NoiseCommandOptions& options, const analysis::NoiseReport& report,
                         const config::Settings& settings) {
  const std::string toml = analysis::noise_configuration(report, settings);
  if (toml.empty())
    throw base::Failure(base::Exit::failed,
                        options.write + ": not written, because no noise of [instruments] was found");
  expect_new(options.write);
  write_result(options.write, toml);
}

void find_noise(const NoiseCommandOptions& options) {
  expect_results({options.request.file, options.config}, {options.page, options.write});
  expect_new(options.write);
  const auto settings = options.config.empty() ? record::Recording::open(options.request.file)->settings()
                                               : config::load(options.config);
  const analysis::NoiseReport report = analysis::noise_of(options.request, settings);
  tell_remarks("navcal", report.remarks);
  print_answer(options.json ? report::noise_json(report) : report::noise_text(report));
  if (!options.page.empty()) write_result(options.page, report::noise_page(report));
  if (!options.write.empty()) write_configuration(options, report, settings);
}

}  // namespace

void add_noise(CLI::App& app) {
  const auto [command, options] = add_command<NoiseCommandOptions>(
      app, "noise", "noise of each channel of a recording at rest: Allan deviation, spectrum, resolution",
      find_noise);
  command->add_option("FILE", options->request.file)->required();
  add_valued(command, "--config", "FILE.toml", options->config);
  add_valued(command, "--from", "S", options->request.from_s);
  add_valued(command, "--to", "S", options->request.to_s);
  command->add_flag("--json", options->json);
  add_valued(command, "--report", "FILE.html", options->page);
  add_valued(command, "--write", "FILE.toml", options->write);
}

}  // namespace navcal::cli
