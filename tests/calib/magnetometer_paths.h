// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/magnetometer/ellipse_shape.h"
#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/turn/turn_step.h"
#include "tests/calib/thesis_paths.h"

/// The magnetometer distortions of the thesis carried on its paths (THESIS 11.4), and motions in the Earth's field
/// of the reference vehicle, for what a magnetometer sees on them.
namespace navcal::calib::test {

/// Figures 4.11 and 4.12: a circle of 20 uT, shifted, flattened by an eccentricity along an axis.
[[nodiscard]] EllipseShape figure_4_11();
[[nodiscard]] EllipseShape figure_4_12();

struct FieldReading {
  Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
  double roll_rad = 0, pitch_rad = 0;
  TurnStep turn;  ///< by the thesis's gyro
};

/// The level field of `shape` along a path, with noise; the gyro is the thesis's (2.11).
[[nodiscard]] std::vector<FieldReading> level_field_on(const std::vector<TruePoint>& path,
                                                       const EllipseShape& shape, const Noise& noise,
                                                       Random& random);

/// Largest and root-mean-square error of the headings that `found` makes of a field without noise, all round.
struct HeadingError {
  double largest_deg = 0, rms_deg = 0;
};
[[nodiscard]] HeadingError heading_error(const FieldCorrection& found, const EllipseShape& truth);

struct Attitude {
  double heading_rad = 0, roll_rad = 0, pitch_rad = 0;
};
/// The reference vehicle's field: 19.0 north, 0.6 east, 44.0 down, from magnetic north.
struct Iron {
  Eigen::Vector3d hard_uT = Eigen::Vector3d::Zero();
  Eigen::Matrix3d soft = Eigen::Matrix3d::Identity();
};
[[nodiscard]] Iron some_iron();
[[nodiscard]] KnownField reference_field();
/// `turn_deg` forth and back, with roll and pitch of two other periods.
[[nodiscard]] std::vector<Attitude> swinging(int readings, double turn_deg, double roll_deg, double pitch_deg);
[[nodiscard]] Eigen::Vector3d field_in_body(const Attitude& attitude);
/// Field readings with the noise of the reference instruments: 0.15 uT, tilt 0.1 degrees.
[[nodiscard]] std::vector<FieldReading> field_on(const std::vector<Attitude>& motion, const Iron& iron,
                                                 Random& random);

}  // namespace navcal::calib::test
