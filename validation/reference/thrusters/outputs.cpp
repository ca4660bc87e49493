// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "protocols/water_linked.h"

namespace navcal::reference::thrusters {
namespace {

constexpr double kNeutral_us = 1500, kHalfRange_us = 400;

/// Of the command on this side of neutral, in one microsecond.
double units_per_us(const PlannedThruster& thruster, bool above) {
  if (thruster.unit == OrderUnit::microseconds) return 1;
  return (above ? thruster.high - thruster.neutral() : thruster.neutral() - thruster.low) / kHalfRange_us;
}

constexpr double kDopplerPeriod_s = 0.125, kDopplerLatency_s = 0.1;
constexpr double kDopplerNoise_m_s = 0.004, kAltitudeNoise_m = 0.03;
constexpr double kLeastUpright = 0.2;

}  // namespace

std::vector<std::uint8_t> output_line(const std::vector<int>& pulses_us) {
  if (pulses_us.size() > kOutputChannels)
    throw std::invalid_argument("more than eight outputs cannot be reported");
  std::string body = "PNCAO";
  for (std::size_t i = 0; i < kOutputChannels; ++i) {
    body += ',';
    if (i < pulses_us.size()) body += std::to_string(pulses_us[i]);
  }
  unsigned sum = 0;
  for (const char letter : body) sum ^= static_cast<unsigned char>(letter);
  constexpr std::array kHex{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F'};
  const std::string line = '$' + body + '*' + kHex[sum >> 4U] + kHex[sum & 15U] + "\r\n";
  return {line.begin(), line.end()};
}

double pulse_of(const PlannedThruster& thruster, double command) {
  const double away = std::clamp(command, thruster.low, thruster.high) - thruster.neutral();
  const double per_us = units_per_us(thruster, away > 0);
  return kNeutral_us + (per_us > 0 ? away / per_us : 0);
}

double command_of(const PlannedThruster& thruster, double pulse_us) {
  const double away_us = pulse_us - kNeutral_us;
  return thruster.neutral() + away_us * units_per_us(thruster, away_us > 0);
}

Doppler::Doppler(const Fitting& fitting, const Errors& errors, double floor_m)
    : Instrument(fitting, Port::doppler, kDopplerPeriod_s, kDopplerLatency_s), errors_(errors),
      start_ns_(fitting.start_ns), floor_m_(floor_m) {}

std::vector<std::uint8_t> Doppler::sample(const History& history, double time_s) {
  const Snapshot s = history.at(time_s);
  const double factor = 1 + errors_.scale + errors_.scale_per_K * (s.electronics_C - kReferenceTemperature_C);
  const Vector3 ground = s.world_from_body.conjugate() * s.ground_velocity_m_s();
  const Vector3 measured = factor * ground + noise3(kDopplerNoise_m_s);
  constexpr double kVariance = kDopplerNoise_m_s * kDopplerNoise_m_s;

  protocols::water_linked::Velocity velocity;
  velocity.velocity_m_s = {measured.x(), measured.y(), measured.z()};
  velocity.valid = true;
  const double upright = std::max(s.down().z(), kLeastUpright);
  velocity.altitude_m = (floor_m_ - s.position_m.z()) / upright + noise(kAltitudeNoise_m);
  velocity.figure_of_merit_m_s = kDopplerNoise_m_s;
  velocity.covariance_m2_s2 = {kVariance, 0, 0, 0, kVariance, 0, 0, 0, kVariance};
  const std::int64_t valid_us = (start_ns_ + std::llround(time_s * 1e9)) / 1000;
  velocity.valid_at_us = valid_us;
  velocity.transmitted_at_us = valid_us + std::llround(kDopplerLatency_s * 1e6);
  velocity.since_last_ms = 1000 * (time_s - last_s_);
  last_s_ = time_s;
  return protocols::water_linked::encode(velocity);
}

}  // namespace navcal::reference::thrusters
