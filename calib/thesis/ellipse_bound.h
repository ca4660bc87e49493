// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/thesis/measured_path.h"

/// Accuracy of an ellipse with the noise of the thesis: root-mean-square error of heading over the circle by the
/// Cramer-Rao bound, degrees.
namespace navcal::calib::thesis {

[[nodiscard]] EllipseEstimator::Parameters ellipse_parameters();

/// Every heading free.
[[nodiscard]] double ellipse_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth);
/// The error that a shape with this covariance makes.
[[nodiscard]] double rms_heading_deg(const EllipseShape& shape, const EllipseShape::Matrix& covariance);

}  // namespace navcal::calib::thesis
