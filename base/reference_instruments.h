// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/angles.h"

/// The reference vehicle's instruments (docs/simulator.md): the values with which settings and options begin. Each
/// value stands here once. Noise is white, one standard deviation of a reading.
namespace navcal::base::reference {

// Compass.
inline constexpr double kFieldNoise_uT = 0.15;                     ///< each axis
inline constexpr double kTiltNoise_rad = 0.1 * kRadiansPerDegree;  ///< roll and pitch
inline constexpr double kTiltLag_s = 0.3;                          ///< first-order lag of the inclinometer's fluid
inline constexpr double kTemperatureNoise_C = 0.1;
/// What calibrators reckon with for this compass: a reading of heading, field and tilt, with what the vehicle's
/// own motion, tilt and rounding add to the noise.
inline constexpr double kReckonedHeadingNoise_rad = 0.5 * kRadiansPerDegree;
inline constexpr double kReckonedFieldNoise_uT = 0.2;
inline constexpr double kReckonedTiltNoise_rad = 0.0018;
// Inertial card.
inline constexpr double kGyroNoise_rad_s = 0.1 * kRadiansPerDegree;
inline constexpr double kTurnOnBias_rad_s = 0.3 * kRadiansPerDegree;  ///< of each gyro, new at each power-on
inline constexpr double kForceNoise_m_s2 = 0.02;
inline constexpr double kDepthNoise_m = 0.02;
// Receiver.
inline constexpr double kPositionNoise_m = 1;      ///< each axis
inline constexpr double kVelocityNoise_m_s = 0.1;  ///< each axis
inline constexpr double kAntennaDepth_m = 0.35;    ///< below this depth of the origin there are no fixes
inline constexpr double kLeastSearch_s = 2, kLongestSearch_s = 10;  ///< from sight of the sky to the first fix
// Motor card.
inline constexpr double kFinNoise_rad = 0.1 * kRadiansPerDegree;
inline constexpr double kCurrentNoise_A = 0.02;

/// Way through the water for one revolution of the shaft, straight ahead, m.
inline constexpr double kAdvance_m = 0.0872;
/// First-order lag of the vehicle's speed behind its shaft's, s.
inline constexpr double kSpeedLag_s = 0.9;
/// The Earth's field at the reference place: north, east, down.
inline constexpr std::array<double, 3> kField_uT{19.0, 0.6, 44.0};
/// Temperature to which the temperature coefficients of the instruments refer, and that of the water at the
/// surface.
inline constexpr double kTemperature_C = 15;

}  // namespace navcal::base::reference
