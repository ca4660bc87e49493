// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace navcal::nav {

/// A stretch without fixes, as the first fix after it showed.
struct Outage {
  double duration_s = 0;
  double distance_m = 0;  ///< run through the water
  double error_m = 0;     ///< from the position reckoned to the fix, whose own noise is in it
  double std_m = 0;       ///< of error_m as stated: root of the sum of the variances of north and east
};

/// Instrument whose velocity the position is reckoned with.
enum class SpeedSource : std::uint8_t {
  none,    ///< the speed is unknown
  shaft,   ///< through the water, ahead
  water,   ///< measured through the water
  bottom,  ///< measured over the bottom
};

/// Standard deviations are what the estimator states of itself (docs/navigation.md).
struct Estimate {
  std::int64_t time_ns = 0;
  std::optional<double> heading_rad;  ///< from true north, 0..2 pi
  double heading_std_rad = 0;
  std::optional<double> pitch_rad, roll_rad;
  std::optional<double> depth_m, depth_std_m;
  std::optional<double> speed_m_s;  ///< through the water, ahead
  SpeedSource speed_source = SpeedSource::none;
  std::uint64_t velocity_outliers = 0;                ///< measurements of a DVL that were passed over, so far
  Eigen::Vector2d set_m_s = Eigen::Vector2d::Zero();  ///< of the ground's velocity over the reckoned one
  std::optional<Eigen::Vector3d> velocity_m_s;        ///< north, east, down, over ground
  std::optional<Eigen::Vector2d> position_m;          ///< north, east; none before the first fix
  Eigen::Vector2d position_std_m = Eigen::Vector2d::Zero();
  double since_fix_s = 0;  ///< with a position
  double since_fix_m = 0;  ///< distance since that fix: through the water, or over the bottom
};

}  // namespace navcal::nav
