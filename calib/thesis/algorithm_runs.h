// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "calib/thesis/turn_problem.h"

/// The thesis's algorithms on the reference paths.
namespace navcal::calib::thesis {

/// (3.5): (abar, bbar).
[[nodiscard]] Eigen::Vector2d thesis_gyro(std::span<const Measured> readings);
/// (3.15, 3.16): (abar, bbar).
[[nodiscard]] Eigen::Vector2d thesis_adaptive(std::span<const Measured> readings);
/// (4.7) with the true scale and bias of the gyro: (B, C, D, E), radians.
[[nodiscard]] Eigen::Vector4d thesis_compass(std::span<const Measured> readings);

/// Compass reading of table 4.1, radians: psi - E(psi), E the deviation of thesis_deviation() at the true heading.
/// The thesis's equation (2.8) has E at the measured heading instead.
[[nodiscard]] double table_4_1_heading_rad(double true_heading_rad);
/// (4.7) as for table 4.1, without noise: (B, C, D, E), radians, with the table's sign.
[[nodiscard]] Eigen::Vector4d table_4_1_compass(std::span<const TruePoint> path);

/// Error of heading in table 4.1, radians: corrected less true, where corrected = measured + Ehat(measured).
[[nodiscard]] double table_4_1_error_rad(const Eigen::Vector4d& B_to_E_rad, double true_heading_rad);
/// Statistics of that error over the headings 0:0.01:2 pi, degrees.
struct HeadingStatistics {
  double mean_deg = 0;
  double largest_deg = 0;  ///< absolute
  double std_deg = 0;      ///< with N - 1
};
[[nodiscard]] HeadingStatistics table_4_1_statistics(const Eigen::Vector4d& B_to_E_rad);

}  // namespace navcal::calib::thesis
