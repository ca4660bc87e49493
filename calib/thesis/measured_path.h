// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "calib/readings.h"

/// A path as the thesis's vehicle would have measured it. Equation and figure numbers: Mach 2003.
namespace navcal::calib::thesis {

/// One row of a path, what is true.
struct TruePoint {
  double time_s = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< north, east
  double roll_rad = 0, pitch_rad = 0;
  double heading_rad = 0;  ///< unwrapped
  Eigen::Vector3d velocity_body_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
};

/// Time between two samples of the thesis's loop.
inline constexpr double kPeriod_s = 0.1;

/// Number of headings 0:0.01:2 pi, with which the thesis goes round the circle: the last gap is 0.0032.
inline constexpr int kCirclePoints = 629;

/// Standard deviations per sample; the thesis's own (figures 3.5, 3.10, 4.6, 4.12).
struct Noise {
  double tilt_rad = 0.001;
  double heading_rad = 0.004;
  double rate_rad_s = 0.005;
  double field_uT = 0.1;
};
inline constexpr Noise kNoNoise{0, 0, 0, 0};

/// Errors that the thesis injects: omega_m = (1 + a) omega + b with a = -0.1, b = 0.1 rad/s (2.11), that is omega
/// = scale omega_m + bias (2.12).
inline constexpr double kTrueScale = 1 / 0.9;
inline constexpr double kTrueBias_rad_s = -0.1 / 0.9;

/// A, B, C, D, E in radians (2.7): A = 0, B = 5, C = -5, D = 2, E = 2 degrees.
using Deviation = Eigen::Matrix<double, 5, 1>;
[[nodiscard]] Deviation thesis_deviation();
/// sin, cos, sin 2, cos 2: what B..E are the coefficients of.
[[nodiscard]] Eigen::Vector4d harmonics(double heading_rad);
/// E(psi_m) of (2.7).
[[nodiscard]] double deviation_rad(const Deviation& coefficients, double measured_heading_rad);
/// psi_m with psi = psi_m - E(psi_m): self-consistent injection (I2 of section 11.2).
[[nodiscard]] double measured_heading_rad(const Deviation& coefficients, double true_heading_rad);

/// One sample of compass and gyro at the same instant, as on the thesis's 10 Hz loop.
struct Measured {
  double time_s = 0;
  double heading_rad = 0;  ///< wrapped to 0..2 pi
  double roll_rad = 0, pitch_rad = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  ///< z by (2.11); x and y true plus noise
};

[[nodiscard]] CompassReading compass_of(const Measured& measured);
/// Gyro B says nothing.
[[nodiscard]] RateReading rate_of(const Measured& measured);

using Random = std::mt19937_64;
/// `deviation` zero: an error-free compass but for noise. Gyro z with the thesis's a and b.
[[nodiscard]] std::vector<Measured> measure(const std::vector<TruePoint>& path, const Deviation& deviation,
                                            const Noise& noise, Random& random);

}  // namespace navcal::calib::thesis
