// SPDX-License-Identifier: Apache-2.0
#include "tests/validation/reference/bench.h"

#include <cmath>

#include "protocols/imu_card.h"
#include "protocols/oncore_position.h"
#include "protocols/tcm2_word.h"
#include "validation/reference/card.h"
#include "validation/reference/compass.h"
#include "validation/reference/receiver.h"

namespace navcal::reference::testing {
namespace {

/// When the last byte of an instrument read at once was measured.
double measured_s(const Transfer& transfer, double latency_s) {
  const double wire_s = 10.0 * static_cast<double>(transfer.bytes.size()) / facts_of(transfer.port).baud;
  return static_cast<double>(transfer.time_ns - kStart_ns) * 1e-9 - wire_s - latency_s;
}

template <class Device>
std::vector<Transfer> all_of(Device& device, const World& world) {
  std::vector<Transfer> out;
  device.catch_up(world, out);
  return out;
}

}  // namespace

ParameterDeviations with(const std::string& name, const std::map<std::string, double, std::less<>>& parameters) {
  ParameterDeviations deviations;
  add({name, parameters}, deviations);
  return deviations;
}

World swung(double duration_s, const VehicleDeviations& deviations) {
  Start start;
  start.position_m = {0, 0, 3};
  World world(Vehicle(Hull{}, deviations, start), duration_s + 1);
  for (int i = 0; i * 4 < duration_s; ++i) {
    const double side = i % 2 == 0 ? 1 : -1, tilt = i % 3 - 1;
    world.vehicle().command(10 + 3 * (i % 3), FinLinkage::mixed(0.2 * side, 0.06 * tilt));
    world.advance(std::min(4.0 * (i + 1), duration_s));
  }
  return world;
}

World near_surface(double duration_s) {
  Start start;
  start.position_m = {0, 0, -5};  // it sinks a little in a turn, and the model has no surface to leave
  World world(Vehicle(Hull{}, {}, start), duration_s + 1);
  world.vehicle().command(12, FinLinkage::mixed(0.2, 0));
  world.advance(duration_s);
  return world;
}

Fitting exact() {
  Fitting fitting;
  fitting.noisy = false;
  fitting.start_ns = kStart_ns;
  fitting.clock_ppm = fitting.host_delay_s = 0;
  return fitting;
}

std::vector<CardSample> card_along(const World& world, const CardDeviations& deviations, const Fitting& fitting) {
  Card card(fitting, deviations);
  std::vector<CardSample> samples;
  for (const Transfer& transfer : all_of(card, world)) {
    const auto record = protocols::imu_card::decode_record(transfer.bytes).value();
    CardSample sample{measured_s(transfer, 0.025), {}};
    for (std::size_t i = 0; i < 8; ++i) {
      const double mV = record.raw[i] / 16.0;
      sample.values[i] = i < 4   ? (mV - 2048) / 10 * kDegree
                         : i < 7 ? (mV - 2048) / 1000 * kGravity_m_s2
                                 : (mV - 250) / 187.5;
    }
    samples.push_back(sample);
  }
  return samples;
}

std::vector<CompassSample> compass_along(const World& world, const CompassDeviations& deviations,
                                         const Fitting& fitting) {
  Compass compass(fitting, deviations);
  std::vector<CompassSample> samples;
  for (const Transfer& transfer : all_of(compass, world)) {
    const auto word = protocols::tcm2::decode_word(transfer.bytes).value();
    samples.push_back({measured_s(transfer, 0.05), *word.heading * kDegree, *word.pitch * kDegree,
                       *word.roll * kDegree, Vector3(*word.x, *word.y, *word.z), *word.temperature});
  }
  return samples;
}

std::vector<FixSample> receiver_along(const World& world, const GpsDeviations& deviations,
                                      const Fitting& fitting) {
  const Anchorage anchorage;
  Receiver receiver(fitting, deviations, anchorage);
  std::vector<FixSample> samples;
  for (const Transfer& transfer : all_of(receiver, world)) {
    const auto p = protocols::oncore::decode_position(transfer.bytes).value();
    const double metres = 6371000 * kDegree;
    FixSample sample{
        measured_s(transfer, 0.3),
        p.fix == protocols::Fix::fix_3d,
        {(p.filtered.latitude_deg - anchorage.latitude_deg) * metres,
         (p.filtered.longitude_deg - anchorage.longitude_deg) * metres *
             std::cos(anchorage.latitude_deg * kDegree)},
        p.speed_m_s * Eigen::Vector2d(std::cos(p.heading_deg * kDegree), std::sin(p.heading_deg * kDegree))};
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace navcal::reference::testing
