// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/fit/estimate.h"
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

/// What a manoeuvre would add to the recordings.
struct ManoeuvreAdvice {
  std::string manoeuvre;
  double seconds = 0;
  double gain_nats = 0;   ///< 1/2 log det of the covariance before over that after
  std::string parameter;  ///< whose standard error falls most, of those that are not told
  double std_before = 0, std_after = 0;
};

/// Manoeuvres of a small table, simulated with the layout and with the instruments of the first recording; those
/// that make an untold number at least a tenth better, best first. The information of a manoeuvre is that of its
/// filter without nuisances, divided by the estimate's model error.
[[nodiscard]] std::vector<ManoeuvreAdvice> advised_manoeuvres(const PredictionErrorProblem& problem,
                                                              const Estimate& estimate,
                                                              const EstimateSettings& settings,
                                                              const FitProgress& progress);

}  // namespace navcal::identify
