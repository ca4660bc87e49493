// SPDX-License-Identifier: Apache-2.0
// What a simulated vehicle costs: ten minutes of a mission, the vehicle and its autopilot alone.
#include <benchmark/benchmark.h>

#include "config/mission_file.h"
#include "sim/layout/layout_of.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace {

using namespace navcal;

void ten_minutes(benchmark::State& state) {
  const config::VehicleSettings vehicle;
  const config::Mission mission = config::load_mission("identification");
  for (auto _ : state) {
    const sim::SimulatedMotion motion(vehicle, std::make_unique<sim::MissionHelm>(vehicle, mission), {});
    benchmark::DoNotOptimize(motion.at(600'000'000'000));
  }
}
BENCHMARK(ten_minutes)->Unit(benchmark::kMillisecond);

void one_step(benchmark::State& state) {
  const sim::LayoutVehicle vehicle(sim::layout_of({}));
  sim::Body body;
  body.velocity[0] = 1;
  const sim::ActuatorValues held = sim::Controls{{-0.2, 0.15, 0.05}, 13}.values();
  for (auto _ : state) body = vehicle.step(body, held, 0.01).body;
  benchmark::DoNotOptimize(body);
}
BENCHMARK(one_step);

}  // namespace

BENCHMARK_MAIN();
