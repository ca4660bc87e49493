// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/imu_card.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

namespace card = protocols::imu_card;
constexpr double kFullScale = 65520;
constexpr double kCountsPer_mV = 16;
constexpr std::int64_t kRateStep_ns = 5'000'000;  ///< to either side, for the change of the rates

}  // namespace

ImuCard::ImuCard(const Options& options, const Motion& motion)
    : LineDevice(options.baud), options_(options), motion_(motion),
      effects_(options.effects != nullptr ? *options.effects : none_), noise_(options.seed) {}

void ImuCard::power_on(std::int64_t t_ns) {
  ticks_ = Ticks(t_ns, 1 / options_.imu.timing.rate_Hz, options_.clock_ppm);
  electronics_.power_on(t_ns, motion_);
  sequence_ = 0;
  for (double& bias : bias_rad_s_) bias = noise_.normal(options_.imu.turn_on_bias_rad_s);
}

void ImuCard::act(std::int64_t now_ns, std::vector<Emission>& out) {
  const double time_s = effects_.time_s(now_ns);
  const double latency_s = options_.imu.timing.latency_s + effects_.delays(time_s).card_s;
  const auto frame = card::encode_record(measure(now_ns - std::llround(latency_s * 1e9)));
  send(now_ns, {frame.begin(), frame.end()}, out);
  ticks_.pass(effects_.slow_ppm(Instrument::imu, time_s));
}

ImuCard::Mounted ImuCard::felt(const State& state, std::int64_t t_ns) const {
  const config::MountingSettings& mounting = options_.imu.mounting;
  Mounted mounted{state.rate_rad_s, state.specific_force_m_s2, state.position_m[2]};
  if (is_away_from_origin(mounting)) {
    const Vector3& place = mounting.position_m;
    const Vector3 before = motion_.at(t_ns - kRateStep_ns).rate_rad_s;
    const Vector3 after = motion_.at(t_ns + kRateStep_ns).rate_rad_s;
    Vector3 change_rad_s2{};
    for (std::size_t i = 0; i < 3; ++i)
      change_rad_s2[i] = (after[i] - before[i]) / (2e-9 * static_cast<double>(kRateStep_ns));
    const Vector3 centripetal = cross(state.rate_rad_s, cross(state.rate_rad_s, place));
    const Vector3 turning_up = cross(change_rad_s2, place);
    for (std::size_t i = 0; i < 3; ++i) mounted.force_m_s2[i] += centripetal[i] + turning_up[i];
    mounted.depth_m += (R_world_from_body(state.euler_rad) * place)[2];
  }
  if (is_turned(mounting)) {
    const Matrix3 device_from_body = transpose(R_body_from_device(mounting));
    mounted.rate_rad_s = device_from_body * mounted.rate_rad_s;
    mounted.force_m_s2 = device_from_body * mounted.force_m_s2;
  }
  return mounted;
}

std::array<double, 8> ImuCard::signals(const Instant& now, const Mounted& mounted) {
  GyroRates rates{};
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = mounted.rate_rad_s[kGyroAxes[i]];
  effects_.gyros(now, rates);
  Vector3 force = mounted.force_m_s2;
  effects_.accelerometers(now, force);
  double depth = mounted.depth_m;
  effects_.depth(now, depth);

  const double louder = effects_.noise(Instrument::imu, now.time_s);
  std::array<double, 8> signals{};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double error_rad_s = bias_rad_s_[i] + noise_.normal(options_.imu.gyro_noise_rad_s * louder);
    signals[i] = (rates[i] + error_rad_s) * base::kDegreesPerRadian;
  }
  for (std::size_t i = 0; i < force.size(); ++i) {
    signals[4 + i] = (force[i] + noise_.normal(options_.imu.force_noise_m_s2 * louder)) / kGravity_m_s2;
  }
  signals[7] = depth + noise_.normal(options_.imu.depth_noise_m * louder);
  return signals;
}

card::Record ImuCard::measure(std::int64_t t_ns) {
  const State state = motion_.at(t_ns);
  const Instant now = effects_.instant(t_ns, state, electronics_.temperature_C(t_ns, motion_));
  CardVoltages_mV voltages = signals(now, felt(state, t_ns));
  for (std::size_t i = 0; i < voltages.size(); ++i) {
    voltages[i] = options_.imu.channels.zero_mV[i] + options_.imu.channels.scale[i] * voltages[i];
  }
  effects_.card_voltages(now, voltages);
  card::Record record;
  record.sequence = sequence_++;
  record.status = status_;
  for (std::size_t i = 0; i < voltages.size(); ++i) {
    const double reading = std::round(kCountsPer_mV * voltages[i]);
    if (reading < 0 || reading > kFullScale) record.status |= card::over_range;
    record.raw[i] = static_cast<std::uint16_t>(std::clamp(reading, 0.0, kFullScale));
  }
  return record;
}

}  // namespace navcal::sim
