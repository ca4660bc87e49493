// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/predicted_instruments.h"

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::gap {
using sim::operator*;  // NOLINT(misc-unused-using-decls): of a matrix and a vector, which are std::array

PredictedInstruments::Card PredictedInstruments::card(double time_s, const sim::State& state) {
  const sim::Instant now = instant(time_s, state);
  Card said;
  for (std::size_t i = 0; i < 4; ++i) said.gyro_rad_s[i] = state.rate_rad_s[sim::kGyroAxes[i]];
  said.force_m_s2 = state.specific_force_m_s2;
  said.depth_m = state.position_m[2];
  effects_.gyros(now, said.gyro_rad_s);
  effects_.accelerometers(now, said.force_m_s2);
  effects_.depth(now, said.depth_m);
  for (std::size_t i = 0; i < 4; ++i) said.gyro_rad_s[i] += bias_rad_s_[i];
  if (effects_.size() == 0) return said;

  const config::ImuCardSettings& card = instruments_.imu.channels;
  sim::CardVoltages_mV voltages{};
  const auto unit = [](std::size_t i) {
    return i < 4 ? base::kRadiansPerDegree : i < 7 ? sim::kGravity_m_s2 : 1.0;
  };
  const auto signal = [&](std::size_t i) -> double& {
    return i < 4 ? said.gyro_rad_s[i] : i < 7 ? said.force_m_s2[i - 4] : said.depth_m;
  };
  for (std::size_t i = 0; i < 8; ++i) voltages[i] = card.zero_mV[i] + card.scale[i] * signal(i) / unit(i);
  effects_.card_voltages(now, voltages);
  for (std::size_t i = 0; i < 8; ++i) signal(i) = (voltages[i] - card.zero_mV[i]) / card.scale[i] * unit(i);
  return said;
}

void PredictedInstruments::feel(double time_s, const sim::State& state) {
  const sim::Instant now = instant(time_s, state);
  sim::Tilt seen{state.euler_rad[0], state.euler_rad[1]};
  effects_.tilt_seen(now, seen);
  const sim::Vector3 settled =
      fluid_.at(time_s, {seen.roll_rad, seen.pitch_rad, 0}, instruments_.compass.tilt_lag_s);
  tilt_ = {settled[0], settled[1]};
  sim::Vector3 earth_uT = state.field_world_uT;
  effects_.earth_field(now, earth_uT);
  field_uT_ = sim::transpose(sim::R_world_from_body(state.euler_rad)) * earth_uT;
  effects_.body_field(now, field_uT_);
}

PredictedInstruments::Word PredictedInstruments::word(double time_s, const sim::State& state) {
  feel(time_s, state);
  Word said{field_uT_, tilt_};
  effects_.tilt_said(instant(time_s, state), said.tilt);
  return said;
}

sim::AntennaMotion PredictedInstruments::antenna(double time_s, const sim::State& state,
                                                 const std::array<double, 2>& offset_m) {
  sim::AntennaMotion motion{state.position_m, sim::R_world_from_body(state.euler_rad) * state.velocity_body_m_s};
  for (std::size_t i = 0; i < 2; ++i) {
    motion.position_m[i] += offset_m[i];
    motion.velocity_m_s[i] += state.current_m_s[i];
  }
  effects_.antenna(instant(time_s, state), motion);
  return motion;
}

}  // namespace navcal::gap
