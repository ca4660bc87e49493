// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/motor.h"

#include <algorithm>
#include <cmath>

#include "protocols/motor_card.h"

namespace navcal::reference {
namespace {

namespace motor_wire = protocols::motor_card;
constexpr double kMotorPeriod_s = 0.1, kMotorLatency_s = 0.005;
constexpr double kFinNoise_deg = 0.1, kCurrentNoise_A = 0.02;

}  // namespace

Motor::Motor(const Fitting& fitting)
    : Instrument(fitting, Port::motor, kMotorPeriod_s, kMotorLatency_s), start_ns_(fitting.start_ns),
      sequence_(static_cast<std::uint8_t>(dice().bits())) {}

void Motor::order(double shaft_rev_s, const Vector3& fins_rad, World& world, std::vector<Transfer>& out) {
  const int rpm = static_cast<int>(std::lround(60 * shaft_rev_s));
  Eigen::Vector3i tenths_deg;
  for (int i = 0; i < 3; ++i) {
    const double tenths = std::round(fins_rad(i) / kDegree * 10);
    tenths_deg(i) =
        static_cast<int>(std::clamp(tenths, -10 * motor_wire::kFinLimit_deg, 10 * motor_wire::kFinLimit_deg));
  }
  if (rpm == rpm_ && tenths_deg == tenths_deg_) return;
  rpm_ = rpm;
  tenths_deg_ = tenths_deg;
  world.vehicle().command(rpm_ / 60.0, tenths_deg_.cast<double>() * (0.1 * kDegree));
  const motor_wire::Command command{rpm_, {tenths_deg(0) / 10.0, tenths_deg(1) / 10.0, tenths_deg(2) / 10.0}};
  out.push_back({Port::motor, true, start_ns_ + std::llround(world.now().time_s * 1e9),
                 motor_wire::encode_command(command)});
}

std::vector<std::uint8_t> Motor::sample(const History& history, double time_s) {
  const Snapshot s = history.at(time_s);
  motor_wire::Status status;
  status.sequence = sequence_++;
  status.rpm_commanded = rpm_;
  status.rpm = static_cast<std::int32_t>(std::lround(60 * s.shaft_rev_s));
  for (int i = 0; i < 3; ++i)
    status.fins_deg[static_cast<std::size_t>(i)] = s.servos_rad(i) / kDegree + noise(kFinNoise_deg);
  status.current_A = s.motor_current_A + noise(kCurrentNoise_A);
  return motor_wire::encode_status(status);
}

}  // namespace navcal::reference
