// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/circle_moments.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace navcal::calib::thesis {

std::optional<CircleMoments> CircleMoments::fit(std::span<const Eigen::Vector2d> level_field_uT) {
  if (level_field_uT.size() < 2) return std::nullopt;
  CircleMoments moments;
  for (const auto& point : level_field_uT) moments.centre_uT += point;
  moments.centre_uT /= static_cast<double>(level_field_uT.size());
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const auto& point : level_field_uT) {
    const Eigen::Vector2d from_centre = point - moments.centre_uT;
    second += from_centre * from_centre.transpose();
  }
  // atan2 instead of the atan of (4.14), which cannot tell the major axis from the minor.
  const double alpha = 0.5 * std::atan2(2 * second(0, 1), second(0, 0) - second(1, 1));
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(alpha).toRotationMatrix();
  Eigen::Vector2d largest = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  for (const auto& point : level_field_uT) {
    largest = largest.cwiseMax(rotation.transpose() * (point - moments.centre_uT));
  }
  if (!(largest.y() > 0)) return std::nullopt;
  moments.matrix = rotation * Eigen::Vector2d(1, largest.x() / largest.y()).asDiagonal() * rotation.transpose();
  return moments;
}

}  // namespace navcal::calib::thesis
