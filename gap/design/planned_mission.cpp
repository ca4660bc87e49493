// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planned_mission.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/angles.h"
#include "base/durations.h"
#include "pipeline/pipeline.h"
#include "protocols/motor_card.h"
#include "sim/motion_in_field.h"
#include "sim/recording.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::gap {
namespace {

/// 2026-01-01; any full second would serve.
constexpr std::int64_t kPlannedBegin_ns = 1'767'225'600 * base::kSecond_ns;

PlannedInstant instant_of(const sim::State& state, double time_s) {
  PlannedInstant now;
  now.time_s = time_s;
  now.north_m = state.position_m[0];
  now.east_m = state.position_m[1];
  now.depth_m = state.position_m[2];
  now.pitch_rad = state.euler_rad[1];
  now.heading_rad = state.euler_rad[2];
  now.speed_m_s = state.velocity_body_m_s[0];
  // psi' = (q sin phi + r cos phi) / cos theta
  now.turn_rate_rad_s =
      (state.rate_rad_s[1] * std::sin(state.euler_rad[0]) + state.rate_rad_s[2] * std::cos(state.euler_rad[0])) /
      std::cos(state.euler_rad[1]);
  now.shaft_rps = state.rpm / 60;
  now.motor_current_A = state.motor_current_A;
  return now;
}

/// Orders to the motor card as the host would have recorded them; repeated ones are left out.
void take_order(const sim::LineRead& sent, std::int64_t begin_ns, Mission& mission) {
  const auto command = protocols::motor_card::decode_command(sent.bytes);
  if (!command) return;
  const double time_s = static_cast<double>(sent.time_ns - begin_ns) * 1e-9;
  mission.commanded_s.push_back(time_s);
  Order order{time_s, static_cast<double>(command->rpm), {}};
  for (std::size_t i = 0; i < order.fins_rad.size(); ++i) {
    order.fins_rad[i] = command->fins_deg[i] * base::kRadiansPerDegree;
  }
  const bool is_repeated = !mission.orders.empty() && mission.orders.back().rpm == order.rpm &&
                           mission.orders.back().fins_rad == order.fins_rad;
  if (!is_repeated) mission.orders.push_back(order);
}

}  // namespace

PlannedMission planned_mission(const config::Mission& steps, double seconds, const Waters& waters,
                               std::uint64_t seed) {
  sim::EffectSet none(kPlannedBegin_ns);
  none.reseed(seed);
  sim::Recording::Options options;
  options.begin_ns = kPlannedBegin_ns;
  options.seed = seed;
  options.effects = &none;
  options.turn_on_bias = false;
  options.instruments = waters.instruments;
  PlannedMission planned;
  Mission orders;
  MissionGatherer gatherer;
  {
    const sim::MotionInField motion(std::make_unique<sim::SimulatedMotion>(
                                        waters.vehicle, std::make_unique<sim::MissionHelm>(waters.vehicle, steps),
                                        sim::MotionOptions{kPlannedBegin_ns, &none, 20}),
                                    waters.field.north_east_down_uT);
    sim::Recording instruments(options, motion);
    config::Settings settings;
    settings.ports = sim::recording_ports(options.instruments);
    pipeline::Pipeline pipeline(samples_only(settings));
    std::vector<sim::LineRead> reads;
    for (double until_s = 0; until_s < seconds; until_s += 1) {
      planned.track.push_back(instant_of(motion.at(kPlannedBegin_ns + std::llround(until_s * 1e9)), until_s));
      reads.clear();
      instruments.advance(kPlannedBegin_ns + std::llround(std::min(until_s + 1, seconds) * 1e9), reads);
      for (const sim::LineRead& read : reads) {
        if (read.sent) {
          take_order(read, kPlannedBegin_ns, orders);
        } else {
          pipeline.bytes(static_cast<std::uint16_t>(read.of), read.time_ns, read.bytes, gatherer);
        }
      }
    }
  }
  planned.mission = gatherer.take(kPlannedBegin_ns, {});
  planned.mission.instruments = waters.instruments;
  planned.mission.field = waters.field;
  planned.mission.commanded_s = std::move(orders.commanded_s);
  planned.mission.orders = std::move(orders.orders);
  for (const Order& order : planned.mission.orders) {
    planned.mission.order_times_s.push_back(order.time_s);
    planned.mission.ordered_fins_rad.push_back(order.fins_rad);
  }
  find_silences(planned.mission);
  return planned;
}

}  // namespace navcal::gap
