// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace navcal::calib::thesis {

/// Model: level field (x, y) = centre + Rot(alpha) diag(1, 1/s) Rot(-alpha) circle, microtesla, evenly spread over
/// whole circles (4.11). The centre is the mean (4.12), alpha comes from the second moments (4.14), s from the two
/// largest values (4.17). As in Mach 2003, for comparison: wrong where the headings are not evenly covered.
struct CircleMoments {
  Eigen::Vector2d centre_uT = Eigen::Vector2d::Zero();
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();  ///< of (4.18)

  /// Nullopt for less than two points.
  [[nodiscard]] static std::optional<CircleMoments> fit(std::span<const Eigen::Vector2d> level_field_uT);
};

}  // namespace navcal::calib::thesis
