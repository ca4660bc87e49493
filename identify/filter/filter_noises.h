// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "identify/data/channel.h"
#include "sim/vehicle/body.h"

namespace navcal::identify {

/// Sizes of what disturbs a vehicle, axis by axis (surge, sway, heave, roll, pitch, yaw), and of its instruments'
/// noise.
struct FilterNoises {
  /// Random walk of the velocity: m/s and rad/s per root of a second.
  sim::Vector6 white = (sim::Vector6() << 0.01, 0.01, 0.01, 0.02, 0.02, 0.02).finished();
  /// Standard deviation of the coloured disturbance d, m/s2 and rad/s2: d' = -d/tau + white noise.
  sim::Vector6 coloured = sim::Vector6::Constant(0.1);
  double tau_s = 3;
  /// Noise of a channel's readings over the stated one.
  std::array<double, kChannels> factor = filled(1);

 private:
  static constexpr std::array<double, kChannels> filled(double with) {
    std::array<double, kChannels> all{};
    for (double& one : all) one = with;
    return all;
  }
};

}  // namespace navcal::identify
