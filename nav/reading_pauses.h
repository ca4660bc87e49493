// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::nav {

/// After a longer pause between two frames of the inertial card the turn within the pause is unknown.
inline constexpr double kRatePause_s = 0.5;
/// A shaft that has not been reported for this long may have stopped.
inline constexpr double kShaftPause_s = 2;
/// A gyro that reports a faster rate is broken. NaN fails the comparison with it, too.
inline constexpr double kMostRate_rad_s = 100;

}  // namespace navcal::nav
