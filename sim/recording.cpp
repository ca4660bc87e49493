// SPDX-License-Identifier: Apache-2.0
#include "sim/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "config/load.h"
#include "protocols/motor_card.h"
#include "protocols/oncore_command.h"
#include "sim/instruments/exact.h"

namespace navcal::sim {
namespace {

constexpr std::uint8_t kEverySecond = 1;

template <class Options>
Options options_of(bool noise) {
  Options options;
  if (!noise) make_exact(options);
  return options;
}

}  // namespace

std::vector<config::PortSettings> recording_ports() {
  using protocols::Protocol;
  return {config::default_port("compass", Protocol::tcm2, 38400),
          config::default_port("imu", Protocol::imu_card, 57600),
          config::default_port("gps", Protocol::oncore, 9600),
          config::default_port("motor", Protocol::motor_card, 19200)};
}

Recording::Recording(const Options& options, const Motion& motion)
    : effects_(options.effects != nullptr ? *options.effects : none_), motion_(motion) {
  Noise seeds(options.seed);
  const auto seed = [&] { return static_cast<std::uint64_t>(seeds.uniform(1, 9e15)); };
  const auto add = [&](Instrument of, std::unique_ptr<Device> device) {
    HostLine::Options line{of, options.noise ? HostLine::Options{}.delay_s : 0, seed()};
    device->power_on(options.begin_ns);
    channels_.push_back({std::move(device), HostLine(line)});
  };
  auto compass = options_of<Tcm2::Options>(options.noise);
  compass.go_at_power_on = compass.field_at_power_on = true;
  compass.seed = seed();
  compass.sensor.effects = &effects_;
  compass.clock_ppm = clock_ppm(options.clocks, "compass", compass.clock_ppm);
  add(Instrument::compass, std::make_unique<Tcm2>(compass, motion));
  auto card = options_of<ImuCard::Options>(options.noise);
  card.seed = seed();
  card.effects = &effects_;
  card.clock_ppm = clock_ppm(options.clocks, "imu", card.clock_ppm);
  if (!options.turn_on_bias) card.turn_on_bias_deg_s = 0;
  add(Instrument::imu, std::make_unique<ImuCard>(card, motion));
  auto receiver = options_of<Oncore::Options>(options.noise);
  receiver.seed = seed();
  receiver.receiver.effects = &effects_;
  receiver.receiver.origin = options.origin;
  if (options.sky_always_seen) {
    receiver.receiver.antenna_depth_m = std::numeric_limits<double>::infinity();
    receiver.receiver.least_search_s = receiver.receiver.longest_search_s = 0;
  }
  add(Instrument::gps, std::make_unique<Oncore>(receiver, motion));
  auto motor = options_of<MotorCard::Options>(options.noise);
  motor.seed = seed();
  motor.effects = &effects_;
  motor.clock_ppm = clock_ppm(options.clocks, "motor", motor.clock_ppm);
  add(Instrument::motor, std::make_unique<MotorCard>(motor, motion));

  const auto poll = protocols::oncore::encode_poll(protocols::oncore::kHa, kEverySecond);
  channels_[static_cast<std::size_t>(Instrument::gps)].device->on_bytes(options.begin_ns, poll);
  sent_.push_back({options.begin_ns, Instrument::gps, true, poll});
}

void Recording::write_orders(std::int64_t t_ns) {
  orders_.clear();
  motion_.take_orders(t_ns, orders_);
  for (const Order& order : orders_) {
    protocols::motor_card::Command command{static_cast<std::int32_t>(std::lround(order.rpm)), {}};
    for (std::size_t i = 0; i < 3; ++i) command.fins_deg[i] = order.fins_rad[i] * 180 / std::numbers::pi;
    sent_.push_back({order.time_ns, Instrument::motor, true, protocols::motor_card::encode_command(command)});
  }
}

void Recording::advance(std::int64_t t_ns, std::vector<LineRead>& out) {
  write_orders(t_ns);
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  std::move(sent_.begin(), sent_.end(), std::back_inserter(out));
  sent_.clear();
  for (auto& [device, line] : channels_) {
    emissions_.clear();
    device->advance(t_ns, emissions_);
    for (const Emission& emission : emissions_) line.take(emission, device->baud(), effects_);
    line.reads_until(t_ns, out);
  }
  std::stable_sort(out.begin() + first, out.end(),
                   [](const LineRead& a, const LineRead& b) { return a.time_ns < b.time_ns; });
}

}  // namespace navcal::sim
