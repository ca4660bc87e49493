// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/angles.h"
#include "calib/coverage.h"
#include "calib/magnetometer/ellipse_gyro.h"
#include "calib/magnetometer/ellipse_judgement.h"
#include "calib/magnetometer/ellipse_shape.h"

namespace navcal::calib {

/// Both components are used, unlike in the ellipse's covariance, because the gyro gives the position on the
/// ellipse.
EllipseShape::Matrix EllipseGyro::stated_covariance(double model_error_uT) const {
  using Columns = Eigen::Matrix<double, EllipseShape::kParameters, 2>;
  std::array<Columns, kSharedSectors> sums;
  sums.fill(Columns::Zero());
  EllipseShape::Vector by_vertical = EllipseShape::Vector::Zero();
  for (std::size_t k = 0; k < std::min(groups_.size(), chain_.headings_rad.size()); ++k) {
    const double turns = chain_.headings_rad[k] / (2 * std::numbers::pi);
    const auto sector = static_cast<std::size_t>((turns - std::floor(turns)) * kSharedSectors) % kSharedSectors;
    const double weight = groups_[k].count / (parameters_.noise_uT * parameters_.noise_uT);
    const Columns slope = weight * EllipseShape::slope(chain_.headings_rad[k]).transpose();
    sums[sector] += slope;
    by_vertical += slope * groups_[k].vertical;
  }
  const EllipseShape::Matrix by_noise = chain_.covariance.topLeftCorner<5, 5>();
  EllipseShape::Matrix covariance = by_noise * std::max(1.0, chain_.misfit);
  const EllipseShape::Vector vertical = kVerticalOffset_uT * (by_noise * by_vertical);
  covariance += vertical * vertical.transpose();
  for (const Columns& sum : sums) {
    const Columns moved = model_error_uT * (by_noise * sum);
    covariance += moved * moved.transpose();
  }
  return covariance;
}

Judgement EllipseGyro::judgement() const {
  constexpr double kFullTurn_rad = 2 * std::numbers::pi;
  constexpr double kLeastArc_rad = 45 * base::kRadiansPerDegree;
  constexpr double kMostMisfit = 4;  // a gyro whose scale or bias differs from the prior shows here
  Judgement judgement;
  judgement.samples = samples_;
  judgement.condition = std::numeric_limits<double>::infinity();
  if (!shape_found_) return judgement.refused("the field has hardly changed", "turn through a full circle");
  judgement.condition = condition_of(chain_.covariance);
  const FieldCoverage coverage(chain_.headings_rad);
  judgement.coverage = coverage.arc_rad() / kFullTurn_rad;
  // Noise alone makes a small circle, on which headings lie anywhere.
  if (chain_.shape.radius_uT() < 30 * parameters_.noise_uT)
    return judgement.refused("the field has hardly changed", "turn through a full circle");
  if (coverage.arc_rad() < kLeastArc_rad) {
    return judgement.refused(
        "headings within " + whole_degrees(coverage.arc_rad()) + " degrees do not tell the field's offset",
        coverage.manoeuvre(kFullTurn_rad / 3));
  }
  if (chain_.misfit > kMostMisfit) {
    return judgement.refused("field and gyro disagree: residuals are " + rounded(std::sqrt(chain_.misfit), 1) +
                                 " times what their noise explains",
                             "calibrate the gyro first, and keep clear of iron");
  }
  const double worst_rad = worst_heading_std_rad(chain_.shape, stated_covariance(parameters_.model_error_uT));
  if (worst_rad >
      accepted_heading_std_rad(parameters_.heading_std_rad, worst_raw_heading_error_rad(chain_.shape))) {
    return judgement.refused("the heading would be uncertain by " +
                                 rounded(worst_rad / base::kRadiansPerDegree, 1) + " degrees where it is worst",
                             coverage.manoeuvre(kFullTurn_rad));
  }
  judgement.accepted = true;
  return judgement;
}

}  // namespace navcal::calib
