// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_judgement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/angles.h"
#include "calib/coverage.h"
#include "calib/magnetometer/ellipse_judgement.h"
#include "calib/magnetometer/ellipsoid_estimator.h"

namespace navcal::calib {

namespace {

/// Tilt that a manoeuvre may ask for. Beyond it more readings help, and more tilt does not.
constexpr double kMostTilt_rad = 1.05;

/// The manoeuvre that reduces the uncertainty of the vertical part, when tilt has reached `tilt_rad`.
std::string tilt_manoeuvre(double tilt_rad) {
  constexpr double kMore_rad = 0.26;
  if (tilt_rad >= kMostTilt_rad) {
    return "turn through full circles again, rolled and pitched far to both sides, and stay there for longer";
  }
  return "turn through a full circle with roll or pitch beyond " +
         whole_degrees(std::min(1.2, tilt_rad + kMore_rad)) + " degrees";
}

/// True when the field came from all sides of the hull, whether or not its tilt was known. The smallest eigenvalue
/// of the mean square of its direction is a third on a whole sphere, and zero on a plane or a line.
bool is_all_round(const EllipsoidCells& cells, const EllipsoidShape& shape) {
  constexpr double kLeastSquare = 0.12, kMostMean = 0.5;
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& cell : cells) {
    const Eigen::Vector3d direction = shape.unit_field(cell.mean.head<3>()).normalized();
    square += direction * direction.transpose();
    mean += direction;
  }
  const double count = std::max(1.0, static_cast<double>(cells.size()));
  const Eigen::Vector3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square / count, Eigen::EigenvaluesOnly).eigenvalues();
  return axes[0] > kLeastSquare && mean.norm() < kMostMean * count;
}

}  // namespace

double EllipsoidEstimator::tilt_seen_rad() const {
  double tilt = 0;
  for (const auto& cell : cells_.cells()) {
    const Eigen::Vector3d down = cell.mean.tail<3>();
    tilt = std::max(tilt, std::atan2(down.head<2>().norm(), down.z()));
  }
  return tilt;
}

Judgement EllipsoidEstimator::judgement() const {
  constexpr double kFullTurn_rad = 2 * std::numbers::pi;
  constexpr double kLeastArc_rad = 3.5;
  Judgement judgement;
  judgement.samples = samples_;
  judgement.condition = std::numeric_limits<double>::infinity();
  if (!fit_)
    return judgement.refused("the field has hardly changed", "turn through a full circle, rolling and pitching");
  judgement.condition = condition_of(fit_->covariance);

  std::vector<double> headings;
  const EllipsoidCells all = cells();
  for (const auto& cell : cells_.cells()) {
    const Eigen::Vector3d unit = fit_->shape.unit_field(cell.mean.head<3>());
    if (std::abs(unit.norm() - 1) > 0.2) continue;  // an outlier's
    const Eigen::Vector3d down = cell.mean.tail<3>();
    const Eigen::Vector2d level =
        levelled(unit, std::atan2(down.y(), down.z()), std::asin(std::clamp(-down.x(), -1., 1.)));
    headings.push_back(std::atan2(-level.y(), level.x()));
  }
  const FieldCoverage coverage(std::move(headings));
  const double tilt_rad = tilt_seen_rad();
  const bool all_round = is_all_round(all, fit_->shape);
  judgement.coverage = all_round ? 1 : coverage.arc_rad() / kFullTurn_rad;
  const std::string tilt_more = "turn through a full circle with roll or pitch beyond ";
  if (coverage.arc_rad() < kLeastArc_rad && tilt_rad < 60 * base::kRadiansPerDegree && !all_round) {
    return judgement.refused("headings within " + whole_degrees(coverage.arc_rad()) + " degrees, tilt within " +
                                 whole_degrees(tilt_rad) + " degrees do not tell the field's offset from its size",
                             coverage.manoeuvre(kFullTurn_rad));
  }
  const double centre = fit_->shape.centre_uT.norm();
  const double field = parameters_.known ? parameters_.known->magnitude_uT : fit_->shape.radius_uT();
  // Errors of the instrument's scales grow with the field that it measures.
  const double relative = parameters_.model_error * (1 + centre / field);
  // An offset of the inclinometer is in the heading with this calibration or without it.
  const EllipsoidError error{.noise = stated_error(*fit_, all, noise_, relative).noise};
  const double vertical_uT = std::sqrt(error.noise(2, 2));
  if (centre - 2 * vertical_uT > field && tilt_rad < 45 * base::kRadiansPerDegree) {
    return judgement.refused("the hard iron of " + rounded(centre, 0) +
                                 " uT exceeds the Earth's field, and tilt within " + whole_degrees(tilt_rad) +
                                 " degrees does not determine it",
                             tilt_more + "45 degrees, or move the magnetometer away from what is magnetic");
  }
  // The limit is a tenth of a large hard iron, even where that exceeds the usual limit: removing the rest is a
  // gain. Only the horizontal offset counts, because an error could imitate a vertical offset.
  if (vertical_uT > std::max(parameters_.offset_std_uT, 0.1 * fit_->shape.centre_uT.head<2>().norm())) {
    return judgement.refused(
        "the vertical offset is uncertain by " + rounded(vertical_uT, 1) +
            " uT: " + (tilt_rad < kMostTilt_rad ? "tilt stayed within " : "too little was seen at tilts up to ") +
            whole_degrees(tilt_rad) + " degrees",
        tilt_manoeuvre(tilt_rad));
  }
  const double worst_rad = worst_heading_std_rad(fit_->shape, error, parameters_.expected_tilt_rad);
  if (worst_rad >
      accepted_heading_std_rad(parameters_.heading_std_rad, worst_raw_heading_error_rad(fit_->shape))) {
    return judgement.refused(
        "the heading would be uncertain by " + rounded(worst_rad / base::kRadiansPerDegree, 1) +
            " degrees where it is worst",
        coverage.arc_rad() < 0.9 * kFullTurn_rad ? coverage.manoeuvre(kFullTurn_rad) : tilt_manoeuvre(tilt_rad));
  }
  judgement.accepted = true;
  return judgement;
}

}  // namespace navcal::calib
