// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <navcal/simulate.h>

#include <cmath>

#include "api/guard.h"
#include "config/load.h"
#include "devices/instrument_model.h"
#include "emulation/simulate_run.h"

namespace navcal::api {
namespace {

constexpr double kShortest_s = 0.01, kLongest_s = 1e6;
constexpr double kSlowestClock = 0.25, kFastestClock = 4;

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::bad_argument, message); }

std::vector<sim::ClockFactor> clocks_of(const std::vector<ClockRate>& clocks) {
  std::vector<sim::ClockFactor> factors;
  for (const ClockRate& clock : clocks) {
    if (clock.port != "compass" && clock.port != "imu" && clock.port != "motor")
      refuse(fmt::format("clocks: {}: must be compass, imu or motor", clock.port));
    if (!(clock.rate >= kSlowestClock && clock.rate <= kFastestClock))
      refuse(fmt::format("clocks: {}: the rate must be 0.25 to 4, not {}", clock.port, clock.rate));
    factors.push_back({clock.port, clock.rate});
  }
  return factors;
}

/// As on the command line: the shortest decimals that read back as the same numbers.
emulation::PlaceArguments where_of(const SimulateOptions& options) {
  emulation::PlaceArguments where;
  if (const auto& place = options.place)
    where.place = fmt::format("{},{},{}", place->latitude_deg, place->longitude_deg, place->height_m);
  if (const auto& field = options.field_uT)
    where.field = fmt::format("{},{},{}", (*field)[0], (*field)[1], (*field)[2]);
  if (!options.date.empty()) where.date = options.date;
  return where;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  return std::filesystem::weakly_canonical(a, error) == std::filesystem::weakly_canonical(b, error);
}

void expect_files(const std::filesystem::path& capture, const SimulateOptions& options) {
  const int given = int{!options.path.empty()} + int{!options.drive.empty()} + int{!options.mission.empty()};
  if (given != 1) refuse("one of path, drive and mission is required");
  if (capture.empty()) refuse("capture: the recording needs a name");
  if (!options.truth.empty() && is_same_file(capture, options.truth))
    refuse(fmt::format("{}: two outputs have this name", capture.string()));
  for (const std::filesystem::path& input : {options.path, options.drive, std::filesystem::path(options.mission),
                                             options.vehicle, options.config, options.effects_file}) {
    for (const std::filesystem::path& output : {capture, options.truth}) {
      if (!input.empty() && !output.empty() && is_same_file(output, input))
        refuse(fmt::format("{}: this file is both input and output", output.string()));
    }
  }
}

emulation::SimulateArguments arguments_of(const std::filesystem::path& capture, const SimulateOptions& options) {
  expect_files(capture, options);
  if (options.seconds && !(*options.seconds >= kShortest_s && *options.seconds <= kLongest_s))
    refuse(fmt::format("seconds: must be 0.01 to 1e6, not {}", *options.seconds));
  emulation::SimulateArguments arguments;
  arguments.path = options.path;
  arguments.drive = options.drive;
  arguments.mission = options.mission;
  arguments.vehicle = options.vehicle;
  arguments.config = options.config;
  for (const auto& effect : options.effects) {
    if (!std::isfinite(effect.strength))
      refuse(fmt::format("effects: {}: the strength is not finite", effect.name));
    arguments.effects.push_back(fmt::format("{}={}", effect.name, effect.strength));
  }
  arguments.effects_file = options.effects_file;
  arguments.clocks = clocks_of(options.clocks);
  arguments.seed = options.seed;
  arguments.no_noise = !options.noise;
  arguments.seconds = options.seconds;
  arguments.capture = capture;
  arguments.truth = options.truth;
  arguments.where = where_of(options);
  arguments.begin_ns = arguments.where.day_ns().value_or(emulation::kSimulatedBegin_ns);
  arguments.place = emulation::simulated_place(arguments.where, arguments.begin_ns);
  if (!options.config.empty()) arguments.instruments = devices::instrument_model(config::load(options.config));
  return arguments;
}

}  // namespace

Simulation simulate(const std::filesystem::path& capture, const SimulateOptions& options) {
  return guarded_with_progress(options.progress, [&](ProgressRelay& relay) {
    const emulation::SimulateArguments arguments = arguments_of(capture, options);
    sim::EffectSet effects = emulation::simulate_effects(arguments);
    const emulation::SimulatedRun run = emulation::simulate_motion(arguments, effects);
    emulation::write_simulation(arguments, run, effects, nullptr,
                                [&](double share) { relay("simulating", share); });
    Simulation simulation{run.duration_s, {}};
    if (!arguments.place.remark.empty()) simulation.remarks.push_back(arguments.place.remark);
    return simulation;
  });
}

}  // namespace navcal::api
