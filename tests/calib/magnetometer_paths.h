// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/magnetometer/magnetometer_estimate.h"
#include "tests/calib/level_field.h"
#include "tests/calib/thesis_paths.h"

/// The magnetometer distortions of the thesis carried on its paths (THESIS 11.4), and motions in the Earth's field
/// of the reference vehicle, for what a magnetometer sees on them.
namespace navcal::calib::test {

using thesis::FieldReading, thesis::figure_4_11, thesis::figure_4_12, thesis::heading_error;
using thesis::HeadingError, thesis::level_field_on;

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
