// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "identify/data/recorded_motion.h"

namespace navcal::identify {

/// Nuisance parameters of one recording: errors of its instruments, the current, and how late the recorded
/// actuators are. All are zero for perfect instruments in still water, but for the dip.
enum class Nuisance : Eigen::Index {
  rate_bias_x,
  rate_bias_y,
  rate_bias_z,
  second_yaw_rate_bias,
  rate_scale_x,
  rate_scale_y,
  rate_scale_z,
  second_yaw_rate_scale,
  rate_drift_x,  ///< of the bias, from the recording's first byte on
  rate_drift_y,
  rate_drift_z,
  force_bias_x,
  force_bias_y,
  force_bias_z,
  force_scale_x,
  force_scale_y,
  force_scale_z,
  imu_turn_x,  ///< small rotation of the inertial unit against the body
  imu_turn_y,
  imu_turn_z,
  roll_offset,
  pitch_offset,
  heading_offset,  ///< with the magnetic declination
  heading_sine,    ///< deviation, sine and cosine of the heading
  heading_cosine,
  dip,  ///< of the Earth's field, beyond that of the recording
  depth_offset,
  gauge_offset,
  depth_scale,  ///< of both depths
  doppler_scale,
  doppler_turn,  ///< about z
  antenna_x,     ///< its place, beyond the configuration's
  antenna_y,
  current_north,
  current_east,
  imu_delay,  ///< ages of the readings beyond their stamps: rates, forces and depth of the inertial unit
  heading_delay,
  doppler_delay,
  fix_delay,
  actuator_delay,  ///< and of the recorded actuators
};
inline constexpr Eigen::Index kNuisances = 40;
using Calibration = Eigen::Matrix<double, kNuisances, 1>;

struct NuisanceDescription {
  std::string_view name, unit;
  double prior_std;  ///< about zero
};

/// Prior standard deviations: of instruments as they are built and fitted (turn-on bias of the gyros by the
/// configuration). The offset of the heading contains the declination, unless that is stated.
[[nodiscard]] const std::array<NuisanceDescription, static_cast<std::size_t>(kNuisances)>& nuisances();
[[nodiscard]] Calibration nuisance_stds(const RecordedMotion& motion);

/// Whether a nuisance is an age. Commands jump, so its differences need a longer step than those of other numbers.
[[nodiscard]] constexpr bool is_delay(Nuisance nuisance) { return nuisance >= Nuisance::imu_delay; }
/// The nuisance that is the age of a channel's readings; nullopt: none is.
[[nodiscard]] std::optional<Nuisance> delay_of(Channel channel);

[[nodiscard]] inline double get(const Calibration& calibration, Nuisance nuisance) {
  return calibration[static_cast<Eigen::Index>(nuisance)];
}

/// Velocity of the water: north, east, 0; m/s.
[[nodiscard]] inline Eigen::Vector3d current_of(const Calibration& calibration) {
  return {get(calibration, Nuisance::current_north), get(calibration, Nuisance::current_east), 0};
}

}  // namespace navcal::identify
