// SPDX-License-Identifier: Apache-2.0
#include "sim/recording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "config/load.h"
#include "protocols/motor_card.h"
#include "protocols/oncore_command.h"
#include "sim/instruments/actuator_outputs.h"
#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"

namespace navcal::sim {
namespace {

constexpr std::uint8_t kEverySecond = 1;

devices::InstrumentModel model_of(const Recording::Options& options) {
  devices::InstrumentModel model =
      options.noise ? options.instruments : devices::without_noise(options.instruments);
  if (!options.turn_on_bias) model.imu.turn_on_bias_rad_s = 0;
  if (options.sky_always_seen) {
    model.gps.antenna_depth_m = std::numeric_limits<double>::infinity();
    model.gps.least_search_s = model.gps.longest_search_s = 0;
  }
  return model;
}

config::PortSettings recording_port(std::string name, protocols::Protocol protocol,
                                    const devices::Timing& timing) {
  config::PortSettings port = config::default_port(std::move(name), protocol, static_cast<int>(timing.baud));
  port.latency_s = timing.latency_s;
  port.latency_std_s = timing.latency_std_s;
  port.rate_Hz = timing.rate_Hz;
  return port;
}

}  // namespace

std::vector<config::PortSettings> recording_ports(const devices::InstrumentModel& instruments,
                                                  CommandPort commands) {
  using protocols::Protocol;
  std::vector<config::PortSettings> ports{recording_port("compass", Protocol::tcm2, instruments.compass.timing),
                                          recording_port("imu", Protocol::imu_card, instruments.imu.timing),
                                          recording_port("gps", Protocol::oncore, instruments.gps.timing),
                                          recording_port("motor", Protocol::motor_card, instruments.motor.timing)};
  ports[0].mounting = instruments.compass.mounting;
  ports[1].imu_card = instruments.imu.channels;
  ports[1].mounting = instruments.imu.mounting;
  ports[2].mounting = instruments.gps.mounting;
  if (commands == CommandPort::outputs) ports[3] = config::outputs_port();
  return ports;
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
  const auto set_up = [&](auto& device, auto& sensor, const devices::Timing& timing) {
    device.baud = static_cast<int>(timing.baud);
    device.seed = seed();
    sensor.effects = &effects_;
  };
  const devices::InstrumentModel model = model_of(options);
  Tcm2::Options compass;
  compass.go_at_power_on = compass.field_at_power_on = true;
  compass.sensor.compass = model.compass;
  set_up(compass, compass.sensor, model.compass.timing);
  compass.clock_ppm = clock_ppm(options.clocks, "compass", compass.clock_ppm);
  add(Instrument::compass, std::make_unique<Tcm2>(compass, motion));
  ImuCard::Options card;
  card.imu = model.imu;
  set_up(card, card, model.imu.timing);
  card.clock_ppm = clock_ppm(options.clocks, "imu", card.clock_ppm);
  add(Instrument::imu, std::make_unique<ImuCard>(card, motion));
  Oncore::Options receiver;
  receiver.receiver.gps = model.gps;
  set_up(receiver, receiver.receiver, model.gps.timing);
  receiver.receiver.origin = options.origin;
  add(Instrument::gps, std::make_unique<Oncore>(receiver, motion));
  if (options.commands == CommandPort::outputs) {
    add(Instrument::motor, std::make_unique<ActuatorOutputs>(motion));
  } else {
    MotorCard::Options motor;
    motor.motor = model.motor;
    set_up(motor, motor, model.motor.timing);
    motor.clock_ppm = clock_ppm(options.clocks, "motor", motor.clock_ppm);
    add(Instrument::motor, std::make_unique<MotorCard>(motor, motion));
  }
  ask_receiver(options.begin_ns);
}

void Recording::ask_receiver(std::int64_t t_ns) {
  const auto poll = protocols::oncore::encode_poll(protocols::oncore::kHa, kEverySecond);
  channels_[static_cast<std::size_t>(Instrument::gps)].device->on_bytes(t_ns, poll);
  sent_.push_back({t_ns, Instrument::gps, true, poll});
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
