// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"

/// Inputs of the estimator: readings in SI units and body axes (x forward, y starboard, z down), each with the
/// time of its measurement, in nanoseconds on one clock of the caller's choice. Nothing here reads a clock.
namespace navcal::nav {

struct RateReading {
  std::int64_t time_ns = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  std::optional<double> depth_m = std::nullopt;
  std::optional<Eigen::Vector3d> specific_force_m_s2 = std::nullopt;
  /// Places of the accelerometers and of the depth gauge, from the vehicle's origin.
  Eigen::Vector3d force_position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d depth_position_m = Eigen::Vector3d::Zero();
  std::optional<double> depth_std_m = std::nullopt;
};

/// Roll and pitch that are not those of an inclinometer with lag.
struct TiltReading {
  std::int64_t time_ns = 0;
  double roll_rad = 0;   ///< positive starboard-down
  double pitch_rad = 0;  ///< positive nose-up
};

struct CompassReading {
  std::int64_t time_ns = 0;
  std::optional<double> heading_rad;  ///< from true north, clockwise
  std::optional<double> pitch_rad;    ///< positive nose-up
  std::optional<double> roll_rad;     ///< positive starboard-down
  bool calibrated = false;            ///< the heading is that of a calibration
  bool tilt_lags = true;              ///< pitch and roll are those of a fluid (AttitudeOptions::tilt_lag_s)
  double heading_std_rad = 0;         ///< of a heading that is not calibrated, where it is larger than Options say
};

struct ShaftReading {
  std::int64_t time_ns = 0;
  double revolutions_per_s = 0;
};

/// Axes of a velocity.
enum class VelocityFrame : std::uint8_t {
  body,   ///< x forward, y starboard, z down
  earth,  ///< north, east, down, as the instrument's own compass has it
};

/// Velocity at the place of the instrument: over the bottom (a DVL with bottom lock), or through the water some
/// metres from the vehicle.
template <bool kOverBottom>
struct VelocityReading {
  std::int64_t time_ns = 0;
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  VelocityFrame frame = VelocityFrame::body;
  double std_m_s = 0;                                    ///< random, each axis
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the instrument, from the vehicle's origin
};
using GroundVelocityReading = VelocityReading<true>;
using WaterVelocityReading = VelocityReading<false>;

/// Depth of a gauge that is not on the card with the gyros.
struct DepthReading {
  std::int64_t time_ns = 0;
  double depth_m = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the gauge, from the vehicle's origin
  std::optional<double> std_m = std::nullopt;
};

struct FixReading {
  std::int64_t time_ns = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< north, east of an origin of the caller's choice
  double std_m = base::reference::kPositionNoise_m;      ///< each axis
  std::optional<Eigen::Vector2d> velocity_m_s;           ///< north, east, over ground
  double velocity_std_m_s = base::reference::kVelocityNoise_m_s;  ///< each axis
};

/// After a longer pause between two frames of the inertial card the turn within the pause is unknown.
inline constexpr double kRatePause_s = 0.5;
/// A shaft that has not been reported for this long may have stopped.
inline constexpr double kShaftPause_s = 2;
/// A gyro that reports a faster rate is broken. NaN fails the comparison with it, too.
inline constexpr double kMostRate_rad_s = 100;

}  // namespace navcal::nav
