// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "calib/correction.h"
#include "calib/magnetometer/ellipse_shape.h"

/// The distorted magnetic fields of the thesis (table 4.2), and headings made of them.
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

}  // namespace navcal::calib::thesis
