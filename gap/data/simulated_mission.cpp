// SPDX-License-Identifier: Apache-2.0
#include "gap/data/simulated_mission.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace navcal::gap {

Mission simulated_mission(const sim::Recording::Options& options, const sim::Motion& motion, double duration_s) {
  config::Settings settings;
  settings.ports = sim::recording_ports(options.instruments);
  pipeline::Pipeline pipeline(samples_only(settings));
  sim::Recording instruments(options, motion);
  MissionGatherer gatherer;
  std::vector<Order> orders;
  std::vector<double> commanded_s;
  std::vector<sim::LineRead> reads;
  const std::int64_t end_ns = options.begin_ns + std::llround(duration_s * 1e9);
  for (std::int64_t t_ns = options.begin_ns; t_ns < end_ns;) {
    t_ns = std::min(t_ns + base::kSecond_ns, end_ns);
    reads.clear();
    instruments.advance(t_ns, reads);
    for (const sim::LineRead& read : reads) {
      if (!read.sent) {
        pipeline.bytes(static_cast<std::uint16_t>(read.of), read.time_ns, read.bytes, gatherer);
      } else if (const auto command = protocols::motor_card::decode_command(read.bytes)) {
        commanded_s.push_back(static_cast<double>(read.time_ns - options.begin_ns) * 1e-9);
        orders.push_back(order_of(*command, commanded_s.back()));
      }
    }
  }
  Mission mission = gatherer.take(options.begin_ns, {});
  mission.instruments = options.instruments;
  mission.orders = std::move(orders);
  mission.commanded_s = std::move(commanded_s);
  mission.take_order_times();
  return mission;
}

}  // namespace navcal::gap
