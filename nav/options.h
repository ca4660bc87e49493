// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/reference_instruments.h"

namespace navcal::nav {

/// Gains are rates: a reading that comes dt after the one before it corrects by 1 - exp(-gain dt) of what it
/// differs. The defaults give 0.02 of the heading and 0.05 of the tilt with every word of a 10 Hz compass, 0.03 of
/// the depth with every frame of a 20 Hz card (docs/navigation.md).
struct AttitudeOptions {
  double heading_gain_per_s = 0.2;
  double tilt_gain_per_s = 0.5;
  /// Integral gains from the differences to the gyro zeros, per second.
  double heading_zero_gain_per_s2 = 0.002;
  double tilt_zero_gain_per_s2 = 0.01;
  double tilt_lag_s = base::reference::kTiltLag_s;  ///< of the inclinometer
};

struct DepthOptions {
  double gain_per_s = 0.6;
  double rate_gain_per_s2 = 0.09;  ///< a quarter of the square of the gain: the fastest return without overshoot
};

struct ReckoningOptions {
  double walk_m2_per_s = 0.02;           ///< growth of the variance of a position, each axis
  double bottom_walk_m2_per_s = 0.0005;  ///< the same while the velocity over the bottom is measured
  double set_m_s = 0.15;                 ///< standard deviation of the set, each axis; 0: there is none
  double set_time_s = 3600;              ///< after which a set is forgotten
  double speed_error = 0.05;             ///< relative, the same all along
  double unknown_speed_m_s = 1.5;        ///< how fast it may go when nothing tells how fast it goes
};

/// Errors of a DVL.
struct VelocityOptions {
  double scale_error = 0.005;                         ///< relative, the same all along; one standard deviation
  double alignment_error_rad = 0.008726646259971648;  ///< of its axes about the vehicle's z axis; one std
};

struct Options {
  AttitudeOptions attitude;
  DepthOptions depth;
  ReckoningOptions reckoning;
  VelocityOptions velocity;
  double advance_m =
      base::reference::kAdvance_m;  ///< through the water for one revolution of the shaft; 0: not known
  double speed_lag_s = base::reference::kSpeedLag_s;  ///< of the vehicle's speed behind its shaft's
  /// How far a heading may be off all along a leg, one standard deviation.
  double heading_error_rad = 0.087266462599716474;
  double heading_error_calibrated_rad = 0.017453292519943295;
};

}  // namespace navcal::nav
