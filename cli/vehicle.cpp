// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/result_file.h"
#include "config/layout/layout_file.h"
#include "config/vehicle_file.h"
#include "report/vehicle_check.h"
#include "sim/layout/layout_of.h"

namespace navcal::cli {
namespace {

struct VehicleCheckArguments {
  std::string layout;
  bool json = false;
};

struct VehicleConvertArguments {
  std::string vehicle, output;
};

void check_layout(const VehicleCheckArguments& arguments) {
  config::Layout layout;
  try {
    layout = config::load_layout(arguments.layout);
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  }
  const sim::Assessment found = sim::assess(layout);
  std::fputs(
      (arguments.json ? report::vehicle_check_json(layout, found) : report::vehicle_check_text(layout, found))
          .c_str(),
      stdout);
  if (!found.cannot_simulate.empty())
    throw analysis::Failure(analysis::Exit::failed,
                            fmt::format("{}: cannot be simulated: {}", arguments.layout, found.cannot_simulate));
}

void convert_vehicle(const VehicleConvertArguments& arguments) {
  expect_no_overwriting({arguments.vehicle}, {arguments.output});
  const bool to_terminal = arguments.output.empty() || arguments.output == "-";
  if (!to_terminal) expect_folder_of(arguments.output);
  config::VehicleSettings vehicle;
  try {
    vehicle = config::load_vehicle(arguments.vehicle);
  } catch (const config::Error& error) {
    throw analysis::Failure(analysis::Exit::bad_input, error.what());
  }
  const std::string toml = config::layout_file(sim::layout_of(vehicle));
  if (to_terminal) {
    std::fputs(toml.c_str(), stdout);
  } else {
    write_result(arguments.output, toml);
  }
}

void add_vehicle_check(CLI::App& vehicle) {
  const auto arguments = std::make_shared<VehicleCheckArguments>();
  auto* const command = vehicle.add_subcommand("check", "What a layout amounts to, and what is odd about it");
  command->add_option("FILE", arguments->layout, "Layout of a vehicle (.toml)")->required();
  command->add_flag("--json", arguments->json, "One JSON object");
  command->footer(
      "Shows masses, trim, stability, natural periods, terminal speeds, turning circle, glides, and which degrees "
      "of\n"
      "freedom the actuators command. Each oddity names the number that shows it and the key to look at. Exit "
      "status 0\n"
      "also with oddities; 1 when the layout cannot be simulated, 3 when it cannot be read.\n\n"
      "Example: navcal vehicle check /usr/share/navcal/vehicles/remus-100.toml");
  command->callback([arguments] { check_layout(*arguments); });
}

void add_vehicle_convert(CLI::App& vehicle) {
  const auto arguments = std::make_shared<VehicleConvertArguments>();
  auto* const command =
      vehicle.add_subcommand("convert", "Write the vehicle file of one propeller and three fins as a layout");
  command->add_option("VEHICLE", arguments->vehicle, "Vehicle file, as navcal simulate --vehicle takes it (.toml)")
      ->required();
  command->add_option("-o,--output", arguments->output, "Layout to be written. Default: standard output")
      ->type_name("LAYOUT.toml");
  command->footer(
      "The layout moves as the vehicle does.\n\n"
      "Example: navcal vehicle convert vehicle.toml -o layout.toml");
  command->callback([arguments] { convert_vehicle(*arguments); });
}

}  // namespace

void add_vehicle(CLI::App& app) {
  auto* const vehicle = app.add_subcommand("vehicle", "Layouts: vehicles of any shape, described by a file");
  vehicle->require_subcommand(1);
  vehicle->footer(
      "A layout states masses, damping and any number of thrusters, surfaces, ballasts and moving masses.\n\n"
      "Example: navcal vehicle check remus-100.toml");
  add_vehicle_check(*vehicle);
  add_vehicle_convert(*vehicle);
}

}  // namespace navcal::cli
