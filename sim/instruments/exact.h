// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/instruments/imu_card.h"
#include "sim/instruments/motor_card.h"
#include "sim/instruments/oncore.h"
#include "sim/instruments/tcm2.h"

namespace navcal::sim {

// Takes noise and turn-on biases from an instrument; resolution and latency stay.

inline void make_exact(Tcm2::Options& options) {
  options.sensor.field_noise_uT = options.sensor.tilt_noise_deg = options.sensor.temperature_noise_C = 0;
}

inline void make_exact(ImuCard::Options& options) {
  options.rate_noise_deg_s = options.turn_on_bias_deg_s = 0;
  options.force_noise_m_s2 = options.depth_noise_m = 0;
}

inline void make_exact(Oncore::Options& options) {
  options.receiver.position_noise_m = options.receiver.velocity_noise_m_s = 0;
}

inline void make_exact(MotorCard::Options& options) { options.fin_noise_deg = options.current_noise_A = 0; }

}  // namespace navcal::sim
