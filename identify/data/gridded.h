// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/angles.h"
#include "identify/data/recorded_motion.h"

namespace navcal::identify {

inline constexpr double kGrid_s = 0.1;
inline constexpr double kGap_s = 2;  ///< between readings, which are interpolated within

/// Readings of a channel at multiples of kGrid_s, interpolated, NaN where none are near; angles are interpolated
/// without jumps.
[[nodiscard]] std::vector<double> on_grid(const RecordedMotion& motion, Channel channel, std::size_t rows);
/// Points of the grid within a recording.
[[nodiscard]] inline std::size_t grid_rows(const RecordedMotion& motion) {
  return static_cast<std::size_t>(motion.duration_s / kGrid_s) + 1;
}

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// One motion on the grid; kUnknown where it is not measured.
struct GriddedMotion {
  std::size_t rows = 0;
  std::array<std::vector<double>, kChannels> values;
  std::vector<Eigen::Vector3d> velocity;   ///< of the body's origin; without a Doppler log by the fixes
  std::vector<Eigen::Vector3d> rates;      ///< by gyros, else by the attitude
  Channel velocity_from = Channel::north;  ///< its first: of the Doppler log, the receiver's, or the position
  bool has_tilt = false, has_gyros = false, has_doppler = false, has_velocity = false, by_bottom = false;

  /// `doppler`: bottom_x or water_x, the velocity that counts where both are measured.
  GriddedMotion(const RecordedMotion& motion, Channel doppler);
  [[nodiscard]] double at(Channel channel, std::size_t k) const {
    const auto& of = values[static_cast<std::size_t>(channel)];
    return of.empty() ? kUnknown : of[k];
  }
  [[nodiscard]] double or_zero(Channel channel, std::size_t k) const {
    return values[static_cast<std::size_t>(channel)].empty() ? 0 : at(channel, k);
  }
  [[nodiscard]] Eigen::Vector3d three(Channel first, std::size_t k) const {
    const auto i = static_cast<std::size_t>(first);
    return {at(first, k), at(static_cast<Channel>(i + 1), k), at(static_cast<Channel>(i + 2), k)};
  }
  [[nodiscard]] Eigen::Vector3d euler(std::size_t k) const {
    return {or_zero(Channel::roll, k), or_zero(Channel::pitch, k), or_zero(Channel::heading, k)};
  }
  [[nodiscard]] double change(Channel channel, std::size_t from, std::size_t to) const {
    const double all = at(channel, to) - at(channel, from);
    return describe(channel).is_angle ? base::wrapped(all) : all;
  }
  static constexpr std::size_t kSlopeSteps = 3;
  static constexpr double kSlope_s = 2 * kSlopeSteps * kGrid_s;
  /// Derivative over kSlope_s.
  [[nodiscard]] double slope(Channel channel, std::size_t k) const;
};

}  // namespace navcal::identify
