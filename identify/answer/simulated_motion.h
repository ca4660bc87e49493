// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/replay/calibration.h"
#include "sim/layout/actuators.h"
#include "sim/vehicle/body.h"

namespace navcal::identify {

/// Rate and noise of one channel.
struct ChannelNoise {
  Channel channel;
  double rate_Hz, std;
};

/// Channels with the rates and the noise that a recording has.
[[nodiscard]] std::vector<ChannelNoise> channels_of(const RecordedMotion& motion);

struct SimulatedMotionRequest {
  std::vector<ChannelNoise> channels;
  double seconds = 60;
  sim::Body start;
  /// Commands at a time in seconds, for a vehicle that moves so; asked for ten times a second, and held in
  /// between.
  std::function<sim::ActuatorValues(double, const sim::Body&)> commands;
  /// Accelerations that disturb the vehicle, body axes; empty: none.
  std::function<sim::Vector6(double)> disturbance;
  Calibration calibration = Calibration::Zero();  ///< errors of the instruments, and the current
  std::optional<std::uint64_t> seed;              ///< nullopt: no noise
  double tilt_lag_s = 0, dip_rad = 0;             ///< of the compass
  bool reports_positions = false;  ///< signals are where thrusters and surfaces are, a hundred times a second
};

/// What instruments would record of the vehicle of a layout under these commands, with the signals that
/// ActuatorInputs takes. Ends early where the motion leaves all bounds.
[[nodiscard]] RecordedMotion simulated_motion(const config::Layout& layout, const SimulatedMotionRequest& request);

}  // namespace navcal::identify
