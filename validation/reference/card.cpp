// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/card.h"

#include <algorithm>
#include <cmath>

#include "protocols/imu_card.h"

namespace navcal::reference {
namespace {

namespace wire = protocols::imu_card;
constexpr double kPeriod_s = 0.05, kLatency_s = 0.025;
constexpr double kTurnOnBias_deg_s = 0.3;
constexpr double kRateNoise_deg_s = 0.1, kForceNoise_m_s2 = 0.02, kDepthNoise_m = 0.02;
constexpr double kMiddle_mV = 2048, kRate_mV_s_per_deg = 10, kForce_mV_per_g = 1000;
constexpr double kSurface_mV = 250, kDepth_mV_per_m = 187.5;
constexpr double kLargest = 65520;
constexpr double kBetweenJumps_s = 20;  ///< in the mean
/// Loss of the converter's reference, as a share of the supply's relative loss.
constexpr double kReferenceShare = 0.05;

}  // namespace

Card::Card(const Fitting& fitting, const CardDeviations& deviations)
    : Instrument(fitting, Port::imu, kPeriod_s, kLatency_s), departures_(deviations),
      sequence_(static_cast<std::uint8_t>(dice().bits())) {
  for (double& bias : bias_rad_s_) bias = noise(kTurnOnBias_deg_s * kDegree);
}

PerGyro Card::rates(const Snapshot& s) {
  const double warmer_K = s.electronics_C - kReferenceTemperature_C;
  const Vector3 down = s.down();
  const Vector3 force = s.acceleration_m_s2 - s.gravity_m_s2 * down;
  const Vector3 w = s.rate_rad_s - (warmer_K * warmer_K * departures_.gyro_twist_rad_per_K2).cross(s.rate_rad_s);
  PerGyro rate;
  for (int i = 0; i < 4; ++i) {
    const int axis = kGyroAxes[static_cast<std::size_t>(i)];
    const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    bool& jumped = jumped_[static_cast<std::size_t>(i)];
    if (departures_.gyro_jump_rad_s != 0 && dice().uniform() < kPeriod_s / kBetweenJumps_s) jumped = !jumped;
    rate(i) =
        w(axis) *
            (1 + departures_.gyro_scale(i) + departures_.gyro_nonlinearity_s_per_rad(i) * std::abs(w(axis))) +
        departures_.gyro_temperature_rad_s_per_K(i) * warmer_K + departures_.gyro_drift_rad_s2(i) * s.time_s +
        departures_.gyro_force_rad_s_per_m_s2.row(i).dot(force.transpose()) +
        departures_.gyro_cross(i, 0) * w(first) + departures_.gyro_cross(i, 1) * w(second) + bias_rad_s_(i) +
        (jumped ? departures_.gyro_jump_rad_s : 0) + noise(kRateNoise_deg_s * kDegree);
  }
  return rate;
}

Vector3 Card::forces(const Snapshot& s) {
  const Vector3 force = s.acceleration_m_s2 - s.gravity_m_s2 * s.down();
  return force + departures_.force_scale.cwiseProduct(force) + departures_.force_bias_m_s2 +
         departures_.vibration_m_s2_per_A2 * s.motor_current_A * s.motor_current_A + noise3(kForceNoise_m_s2);
}

double Card::depth(const Snapshot& s) {
  const double half_m = departures_.depth_backlash_m / 2, true_m = s.position_m.z();
  seat_m_ = std::clamp(seat_m_, true_m - half_m, true_m + half_m);
  return seat_m_ * (1 + departures_.depth_scale) +
         departures_.depth_temperature_m_per_K * (s.electronics_C - kReferenceTemperature_C) +
         noise(kDepthNoise_m);
}

std::vector<std::uint8_t> Card::sample(const History& history, double time_s) {
  const Snapshot s = history.at(time_s - departures_.latency_s);
  const PerGyro rate = rates(s);
  const Vector3 force = forces(s);
  const double depth_m = depth(s);
  reading_ = {rate(2), rate(1), depth_m, rate(0)};

  Eigen::Array<double, 8, 1> mV;
  mV.head<4>() = kMiddle_mV + kRate_mV_s_per_deg / kDegree * rate;
  mV.segment<3>(4) = kMiddle_mV + kForce_mV_per_g / kGravity_m_s2 * force.array();
  mV(7) = kSurface_mV + kDepth_mV_per_m * depth_m;
  mV *= (1 + departures_.droop_per_A * s.motor_current_A) / (1 - kReferenceShare * s.supply_loss);

  wire::Record record;
  record.sequence = sequence_++;
  for (int i = 0; i < 8; ++i) {
    const double counts = std::round(16 * mV(i));
    if (counts < 0 || counts > kLargest) record.status |= wire::over_range;
    record.raw[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::clamp(counts, 0.0, kLargest));
  }
  const auto frame = wire::encode_record(record);
  return {frame.begin(), frame.end()};
}

}  // namespace navcal::reference
