// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "runs/run.h"

/// The response of a vehicle to its commands, as parameters of a physical model.
///
/// Thrust follows a rotor's law: thrust ~ U = mean over thrusters of sign (u - u0) ((u - u0) / 100 us)^2 (V / 12
/// V)^2, with command u, stop command u0 and battery voltage V. Depth gained and attitude change in a fixed time
/// are proportional to U while drag is linear; a steady yaw rate under quadratic drag is proportional to sqrt(U).
/// Each parameter is what was measured over what the commands ask for. So neither command nor voltage is a
/// parameter.
namespace navcal::runs {

enum Parameter {
  kDepthZero,     ///< depth read at the surface before the thrusters start, m
  kHeaveEarly,    ///< log of depth gained 1.5 to 2.5 s after the start, m, over U
  kHeaveLater,    ///< the same, 3.5 to 5 s after the start
  kSinkLate,      ///< depth gained from there to 6.5 to 8.5 s, over U, m
  kRollTrim,      ///< roll under thrust less roll at rest, over U, rad
  kPitchTrim,     ///< the same of pitch
  kYawRateLate,   ///< yaw rate 5 to 9 s after the start, over sqrt(U), rad/s
  kYawRateEarly,  ///< the same, 1.5 to 3 s
  kDepthNoise,    ///< log of the standard deviation of white noise in the depth readings, m
  kParameterCount
};

struct ParameterInformation {
  std::string_view name, unit;
  /// Scatter from session to session that is granted to any vehicle, in the unit.
  double tolerance;
};
extern const std::array<ParameterInformation, kParameterCount> kParameters;

/// Bands of the spectrum of the yaw rate: centres from 1.5 Hz on, 0.25 Hz apart, to 9.5 Hz or half the row rate.
inline constexpr double kBandWidth_Hz = 0.25;
[[nodiscard]] constexpr double band_centre_Hz(Eigen::Index band) {
  return 1.5 + kBandWidth_Hz * static_cast<double>(band);
}
[[nodiscard]] Eigen::Index bands_at(double row_rate_Hz);

/// How the vehicle lay before the thrusters started. It tells sessions with other ballast apart.
struct RestState {
  double clock_s = 0, roll_rad = 0, pitch_rad = 0;
  double surface_pressure = 0;  ///< reading of the depth sensor
};

struct Response {
  /// NaN where the run does not show it.
  Eigen::Matrix<double, kParameterCount, 1> parameters;
  /// Power of the yaw acceleration in each of bands_at(row rate), dB; none when the run is too short.
  std::optional<Eigen::VectorXd> spectrum_dB;
  std::optional<RestState> rest;
  /// The thrusters ran.
  bool driven = false;
};

/// What has to be known of the vehicle to read a run.
struct RunClock {
  double row_rate_Hz = 0;
  double stop_command_us = 0;
};

[[nodiscard]] Response response_of(const Run& run, const RunClock& clock);

}  // namespace navcal::runs
