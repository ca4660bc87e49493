// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "bench/calibration/turn_problem.h"

/// The thesis's algorithms on the reference paths.
namespace navcal::bench {

/// (3.5): (abar, bbar).
[[nodiscard]] Eigen::Vector2d thesis_gyro(std::span<const calib::test::Measured> readings);
/// (3.15, 3.16): (abar, bbar).
[[nodiscard]] Eigen::Vector2d thesis_adaptive(std::span<const calib::test::Measured> readings);
/// (4.7) with the true scale and bias of the gyro: (B, C, D, E), radians.
[[nodiscard]] Eigen::Vector4d thesis_compass(std::span<const calib::test::Measured> readings);

}  // namespace navcal::bench
