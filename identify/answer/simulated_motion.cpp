// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/simulated_motion.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "identify/data/actuator_inputs.h"
#include "identify/replay/predicted_readings.h"

namespace navcal::identify {
namespace {

constexpr double kOrderEvery_s = 0.1;

/// Of two signals of a shaft the first is its position, the last its command.
void note(RecordedMotion& motion, const config::Layout& layout, double time_s, const sim::ActuatorValues& values,
          bool are_positions) {
  const auto put = [&](const std::vector<std::string>& names, double value) {
    if (names.empty()) return;
    Signal& signal = motion.signals[are_positions ? names.front() : names.back()];
    signal.times_s.push_back(time_s);
    signal.values.push_back(value);
  };
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i)
    put(signals_of_thruster(layout, i), values.thrusters[i]);
  for (std::size_t i = 0; i < layout.surfaces.size(); ++i)
    put(signals_of_surface(layout, i), values.surfaces_rad[i]);
  for (std::size_t i = 0; i < layout.ballasts.size(); ++i)
    if (!layout.ballasts[i].channel.empty()) put({layout.ballasts[i].channel}, values.ballasts_N[i]);
  for (std::size_t i = 0; i < layout.moving_masses.size(); ++i)
    if (!layout.moving_masses[i].channel.empty()) put({layout.moving_masses[i].channel}, values.masses_m[i]);
}

}  // namespace

std::vector<ChannelNoise> channels_of(const RecordedMotion& motion) {
  std::vector<ChannelNoise> all;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto& readings = motion.channels[c];
    if (readings.size() < 2) continue;
    const double span_s = readings.back().time_s - readings.front().time_s;
    if (!(span_s > 0)) continue;
    std::vector<double> stds;
    for (const Reading& reading : readings) stds.push_back(reading.std);
    std::nth_element(stds.begin(), stds.begin() + static_cast<std::ptrdiff_t>(stds.size() / 2), stds.end());
    all.push_back(
        {static_cast<Channel>(c), static_cast<double>(readings.size() - 1) / span_s, stds[stds.size() / 2]});
  }
  return all;
}

RecordedMotion simulated_motion(const config::Layout& layout, const SimulatedMotionRequest& request) {
  const sim::LayoutVehicle vehicle(layout);
  RecordedMotion recorded;
  recorded.name = "simulated";
  recorded.duration_s = request.seconds;
  recorded.fins_are_reported = request.reports_positions;
  ReplayedMotion motion{0, {}};
  sim::Body body = request.start;
  sim::ActuatorValues positions = sim::ActuatorValues::neutral(layout), commands = positions;
  const double step_s = ActuatorTrajectory::kStep_s;
  const auto per_point = static_cast<long>(std::lround(ReplayedMotion::kStep_s / step_s));
  const auto per_order = static_cast<long>(std::lround(kOrderEvery_s / step_s));
  for (long k = 0; k <= std::lround(request.seconds / step_s); ++k) {
    const double time_s = step_s * static_cast<double>(k);
    if (k % per_order == 0) {
      commands = request.commands(time_s, body);
      if (!request.reports_positions) note(recorded, layout, time_s, commands, false);
    }
    if (request.reports_positions) note(recorded, layout, time_s, positions, true);
    sim::ActuatorValues next = sim::follow(layout, positions, commands, step_s);
    const sim::Vector6 disturbance = request.disturbance ? request.disturbance(time_s) : sim::Vector6::Zero();
    auto step = vehicle.step(body, sim::mean_of(positions, next), step_s);
    if (k % per_point == 0) {
      const sim::LayoutVehicle::Held now = vehicle.hold(positions);
      MotionPoint point;
      point.body = body;
      point.acceleration =
          now.mass_inverse * vehicle.force(body.velocity, sim::down_of(body.euler_rad), now) + disturbance;
      motion.points.push_back(point);
    }
    step.body.velocity += step_s * disturbance;
    const bool is_sane = std::abs(step.body.euler_rad.y()) < 1.5 && step.body.velocity.cwiseAbs().maxCoeff() < 30;
    if (!is_sane) {
      recorded.duration_s = time_s;
      break;
    }
    body = step.body;
    positions = std::move(next);
  }
  if (motion.points.size() < 3) return recorded;
  recorded.tilt_lag_s = request.tilt_lag_s;
  recorded.dip_rad = request.dip_rad;
  motion.points.front().tilt_rad = motion.points.front().body.euler_rad.head<2>();
  add_lagged_tilt(motion, request.tilt_lag_s);
  std::vector<ChannelReading> readings;
  for (const ChannelNoise& channel : request.channels) {
    const double end_s = ReplayedMotion::kStep_s * static_cast<double>(motion.points.size() - 1);
    for (double time_s = 0.5 / channel.rate_Hz; time_s < end_s; time_s += 1 / channel.rate_Hz)
      readings.push_back({channel.channel, time_s, 0, channel.std});
  }
  const Eigen::VectorXd values = PredictedReadings(recorded)(motion, readings, request.calibration);
  std::mt19937_64 random(request.seed.value_or(0));
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double noise = request.seed ? readings[i].std * normal(random) : 0;
    recorded.channels[static_cast<std::size_t>(readings[i].channel)].push_back(
        {readings[i].time_s, values[static_cast<Eigen::Index>(i)] + noise, readings[i].std});
  }
  return recorded;
}

}  // namespace navcal::identify
