// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "base/progress.h"
#include "cli/live/commands.h"
#include "cli/live/exit_statuses.h"
#include "cli/live/result_file.h"
#include "cli/recorded_motions.h"
#include "config/layout/layout_file.h"
#include "config/load.h"
#include "config/vehicle_file.h"
#include "identify/answer/prediction.h"
#include "identify/conventions/conventions.h"
#include "report/vehicle_report.h"
#include "sim/layout/layout_of.h"

namespace navcal::cli {
namespace {

struct VehicleCheckArguments {
  std::string layout, config;
  std::vector<std::string> files;
  bool json = false;
};

struct VehiclePredictArguments {
  std::string layout, json, config;
  std::vector<std::string> files, fit;
  double every_s = 5;
};

struct VehicleConvertArguments {
  std::string vehicle, output;
};

void check_recordings(const VehicleCheckArguments& arguments) {
  const config::Layout layout = config::load_layout(arguments.layout);
  std::optional<config::Settings> settings;
  if (!arguments.config.empty()) settings = config::load(arguments.config);
  base::Progress progress("vehicle check", base::Progress::Answer::at_the_end);
  record::SeenRecordings seen;
  const identify::ConventionCheck found =
      identify::check_conventions(layout, load_motions(arguments.files, settings, progress, seen),
                                  [&](double done) { progress.show("checking", done); });
  print_answer(arguments.json ? report::conventions_json(found) : report::conventions_text(found));
}

void check_layout(const VehicleCheckArguments& arguments) {
  if (!arguments.files.empty())
    return with_exit_statuses([&] { check_recordings(arguments); }, base::Exit::bad_input);
  const config::Layout layout = config::load_layout(arguments.layout);
  const sim::Assessment found = sim::assess(layout);
  std::fputs(
      (arguments.json ? report::vehicle_check_json(layout, found) : report::vehicle_check_text(layout, found))
          .c_str(),
      stdout);
  if (!found.cannot_simulate.empty())
    throw base::Failure(base::Exit::failed,
                        fmt::format("{}: cannot be simulated: {}", arguments.layout, found.cannot_simulate));
}

identify::Prediction prediction_of(const VehiclePredictArguments& arguments) {
  identify::PredictionRequest request;
  request.layout = config::load_layout(arguments.layout);
  request.every_s = arguments.every_s;
  std::optional<config::Settings> settings;
  if (!arguments.config.empty()) settings = config::load(arguments.config);
  base::Progress progress("vehicle predict", base::Progress::Answer::at_the_end);
  record::SeenRecordings seen;
  request.recordings = load_motions(arguments.files, settings, progress, seen);
  record::SeenRecordings seen_fit;  // the regressions may be fitted to what is predicted
  request.fit = load_motions(arguments.fit, settings, progress, seen_fit);
  return identify::predict(request, [&](double done) { progress.show("predicting", done); });
}

void predict_vehicle(const VehiclePredictArguments& arguments) {
  expect_results(all_paths({arguments.files, arguments.fit}, {arguments.layout, arguments.config}),
                 {arguments.json});
  with_exit_statuses(
      [&] {
        const identify::Prediction found = prediction_of(arguments);
        give_answer(arguments.json, report::vehicle_prediction_json(found),
                    report::vehicle_prediction_text(found));
      },
      base::Exit::bad_input);
}

void convert_vehicle(const VehicleConvertArguments& arguments) {
  expect_results({arguments.vehicle}, {arguments.output});
  const std::string toml = config::layout_file(sim::layout_of(config::load_vehicle(arguments.vehicle)));
  if (arguments.output.empty() || arguments.output == "-") {
    std::fputs(toml.c_str(), stdout);
  } else {
    write_result(arguments.output, toml);
  }
}

void add_vehicle_check(CLI::App& vehicle) {
  const auto [command, arguments] = add_command<VehicleCheckArguments>(
      vehicle, "check", "What a layout amounts to, and what is odd about it", check_layout);
  command->add_option("LAYOUT", arguments->layout)->required();
  command->add_option("FILE", arguments->files);
  add_valued(command, "--config", "FILE.toml", arguments->config);
  command->add_flag("--json", arguments->json);
}

void add_vehicle_predict(CLI::App& vehicle) {
  const auto [command, arguments] = add_command<VehiclePredictArguments>(
      vehicle, "predict", "How well a layout predicts recorded motion, beside the simplest methods",
      predict_vehicle);
  command->add_option("LAYOUT", arguments->layout)->required();
  command->add_option("FILE", arguments->files)->required();
  add_repeatable(command, "--fit", "TRAIN", arguments->fit);
  add_number(command, "--every", 0.1, 3600.0, arguments->every_s);
  add_valued(command, "--json", "FILE|-", arguments->json);
  add_valued(command, "--config", "FILE.toml", arguments->config);
}

void add_vehicle_convert(CLI::App& vehicle) {
  const auto [command, arguments] = add_command<VehicleConvertArguments>(
      vehicle, "convert", "Write the vehicle file of one propeller and three fins as a layout", convert_vehicle);
  command->add_option("VEHICLE", arguments->vehicle)->required();
  command->add_option("-o,--output", arguments->output)->type_name("LAYOUT.toml");
}

}  // namespace

void add_vehicle(CLI::App& app) {
  auto* const vehicle = app.add_subcommand("vehicle", "Layouts: vehicles of any shape, described by a file");
  vehicle->require_subcommand(1);
  add_vehicle_check(*vehicle);
  add_vehicle_predict(*vehicle);
  add_vehicle_convert(*vehicle);
}

}  // namespace navcal::cli
