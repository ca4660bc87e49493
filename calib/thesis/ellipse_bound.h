// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/magnetometer/ellipse_gyro.h"
#include "calib/thesis/measured_path.h"

/// Accuracy of an ellipse with the noise of the thesis: root-mean-square error of heading over the circle by the
/// Cramer-Rao bound, degrees.
namespace navcal::calib::thesis {

[[nodiscard]] EllipseEstimator::Parameters ellipse_parameters();
/// The gyro known exactly, or unknown.
[[nodiscard]] EllipseGyro::Parameters gyro_parameters(bool unknown);

/// Every heading free.
[[nodiscard]] double ellipse_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth);
/// Headings tied by the gyro with its noise: dense information on all unknowns, inverted as it is.
[[nodiscard]] double gyro_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth, bool unknown);

}  // namespace navcal::calib::thesis
