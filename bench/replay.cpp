// SPDX-License-Identifier: Apache-2.0
// Speed of the dynamics and of the diagnosis that it serves: simulated seconds of a vehicle per second of one core
// (vehicle_s/s), and the Jacobian of a replay as a multiple of one replay.
#include <benchmark/benchmark.h>

#include "config/layout/layout_file.h"
#include "config/mission_file.h"
#include "gap/design/planned_run.h"
#include "gap/inference/linearised.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"

namespace {

using namespace navcal;

void rate(benchmark::State& state, double vehicle_s) {
  state.counters["vehicle_s/s"] = benchmark::Counter(vehicle_s, benchmark::Counter::kIsIterationInvariantRate);
}

void steps(benchmark::State& state, const config::Layout& layout) {
  const sim::LayoutVehicle vehicle(layout);
  sim::ActuatorValues commands = sim::ActuatorValues::neutral(layout);
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    commands.thrusters[i] = (layout.thrusters[i].neutral() + layout.thrusters[i].high) / 2;
  sim::LayoutRun run(vehicle, {});
  for (auto _ : state) run.advance(commands, 1);
  rate(state, 1);
}
BENCHMARK_CAPTURE(steps, reference, sim::layout_of({}));
BENCHMARK_CAPTURE(steps, bluerov2_heavy,
                  config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml"));
BENCHMARK_CAPTURE(steps, slocum, config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/slocum.toml"));

constexpr double kRecorded_s = 120;

const gap::Mission& recorded() {
  static const gap::Mission mission =
      gap::planned_readings({}, config::load_mission("identification"), {}, kRecorded_s);
  return mission;
}

void one_replay(benchmark::State& state) {
  const gap::Replay replay(recorded(), {});
  for (auto _ : state) benchmark::DoNotOptimize(replay.run({}));
  rate(state, kRecorded_s);
}
BENCHMARK(one_replay)->Unit(benchmark::kMillisecond);

/// All columns of the library. Divided by one_replay it is the cost of the Jacobian.
void jacobian(benchmark::State& state) {
  const gap::Replay replay(recorded(), {});
  const gap::Library library({});
  const gap::Whitening whitening = gap::Whitening::nominal(recorded().instruments);
  const gap::ResidualModel model{replay, library, whitening};
  const Eigen::VectorXd at = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  const Eigen::VectorXd residual = gap::residual_at(model, at);
  const std::vector<Eigen::Index> columns = library.moving();
  for (auto _ : state) benchmark::DoNotOptimize(gap::design_at(model, at, residual, columns));
  state.counters["columns"] = static_cast<double>(columns.size());
}
BENCHMARK(jacobian)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
