// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "calib/correction.h"
#include "calib/magnetometer/ellipse_estimator.h"
#include "calib/magnetometer/ellipse_shape.h"
#include "calib/thesis/measured_path.h"

/// The distorted magnetic fields of the thesis (table 4.2), headings made of them, and the accuracy that the
/// thesis's noise allows.
namespace navcal::calib::thesis {

/// Radius of the undistorted circle: the horizontal field, uT.
inline constexpr double kCircle_uT = 20;

/// A row of table 4.2.
struct FieldDistortion {
  Eigen::Vector2d shift_uT = Eigen::Vector2d::Zero();  ///< forward, starboard
  double eccentricity = 0;                             ///< minor axis = major axis sqrt(1 - eccentricity^2)
  double axis_deg = 0;                                 ///< of the major axis, clockwise from forward
};

/// Field of a level vehicle: the circle of kCircle_uT, flattened across an axis and shifted.
[[nodiscard]] EllipseShape distorted_circle(const FieldDistortion& distortion);
[[nodiscard]] EllipseShape figure_4_11();
[[nodiscard]] EllipseShape figure_4_12();

/// Error of the heading that `found` makes of the field without noise at a true heading, radians.
[[nodiscard]] double heading_error_rad(const FieldCorrection& found, const EllipseShape& truth,
                                       double heading_rad);

/// Largest and root-mean-square error of heading over the circle, degrees.
struct HeadingError {
  double largest_deg = 0, rms_deg = 0;
};
[[nodiscard]] HeadingError heading_error(const FieldCorrection& found, const EllipseShape& truth);

/// An estimator with these is told the thesis's noise.
[[nodiscard]] EllipseEstimator::Parameters ellipse_parameters();

/// Root-mean-square error of heading over the circle by the Cramer-Rao bound, every heading free, degrees.
[[nodiscard]] double ellipse_bound_deg(const std::vector<TruePoint>& path, const EllipseShape& truth);
/// The same for a shape with this covariance, degrees.
[[nodiscard]] double rms_heading_deg(const EllipseShape& shape, const EllipseShape::Matrix& covariance);

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
