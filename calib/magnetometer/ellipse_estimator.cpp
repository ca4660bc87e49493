// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_estimator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "calib/magnetometer/ellipse_judgement.h"
#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {
namespace {

constexpr std::uint64_t kFirstEllipseFit = 20;  // readings
constexpr int kMostEllipseIterations = 200;

/// A beginning that depends on the summary alone; the scatter about it is where robust weights begin.
std::optional<EllipseFit> started(const EllipseCells& cells) {
  const auto shape = taubin_ellipse(cells);
  if (!shape) return std::nullopt;
  EllipseFit fit;
  fit.shape = *shape;
  double square = 0, count = 0;
  for (const auto& cell : cells) {
    const double distance = mean_distance_uT(*shape, cell);
    square += cell.count * distance * distance;
    count += cell.count;
  }
  fit.residual_uT = std::sqrt(square / count);
  return fit;
}

}  // namespace

EllipseEstimator::EllipseEstimator(const Parameters& parameters) : parameters_(parameters), cells_(kCellSize_uT) {}

void EllipseEstimator::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  const Eigen::Vector2d field = levelled(field_body_uT, roll_rad, pitch_rad);
  if (!field.allFinite() || field.cwiseAbs().maxCoeff() > kHighestField_uT) return;
  if (fit_) {
    // The fit is judged only where it is accurate; elsewhere its residuals are meaningless.
    const double known_to = worst_heading_std_rad(fit_->shape, fit_->covariance);
    if (known_to < parameters_.heading_std_rad) {
      const double size = (fit_->shape.axes_uT.inverse() * (field - fit_->shape.centre_uT)).norm();
      held_out_.update(field.norm(), fit_->shape.radius_uT() * (size - 1));
    }
  }
  Eigen::Vector4d reading;
  reading << field, vertical_in_level(roll_rad, pitch_rad);
  cells_.add(reading);
  ++samples_;
  if (samples_ < kFirstEllipseFit) return;
  // Early beginnings are poor ones, on short arcs: begun anew each time the readings have doubled.
  if (std::has_single_bit(samples_ / kFirstEllipseFit) && samples_ % kFirstEllipseFit == 0)
    fit_ = started(cells_.cells());
  if (samples_ % static_cast<std::uint64_t>(parameters_.slice_samples) != 0) return;
  if (!fit_) fit_ = started(cells_.cells());
  if (fit_) fit_ = improve(*fit_, cells_.cells(), parameters_.noise_uT);
}

void EllipseEstimator::absorb(const EllipseEstimator& other) {
  for (const auto& cell : other.cells_.cells()) cells_.add(cell);
  samples_ += other.samples_;
}

void EllipseEstimator::settle() {
  fit_ = started(cells_.cells());
  for (int i = 0; fit_ && !fit_->settled && i < kMostEllipseIterations; ++i) {
    fit_ = improve(*fit_, cells_.cells(), parameters_.noise_uT);
  }
}

double EllipseEstimator::surprise(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) const {
  if (!fit_ || held_out_.weight() < kJudged) return 0;
  EllipseCells::value_type reading;
  reading.count = 1;
  reading.mean.head<2>() = levelled(field_body_uT, roll_rad, pitch_rad);
  if (!reading.mean.head<2>().allFinite()) return 0;  // nothing is said of a field whose tilt is not known
  const Eigen::Vector2d u = fit_->shape.foot(reading.mean.head<2>());
  const Eigen::Vector2d normal = (fit_->shape.axes_uT.inverse() * u).normalized();
  const EllipseShape::Vector row = EllipseShape::slope(u).transpose() * normal;
  const double distance = mean_distance_uT(fit_->shape, reading);
  const double noise_uT = std::max(fit_->residual_uT, held_out_.after_uT());
  // Every tilt brings a share of the vertical offset, which the ellipse does not determine, into the level. So
  // a dive is not a change of the field.
  const double tilted_uT = kVerticalOffset_uT * std::hypot(std::sin(roll_rad), std::sin(pitch_rad));
  const double variance = noise_uT * noise_uT + row.dot(fit_->covariance * row) +
                          parameters_.model_error_uT * parameters_.model_error_uT + tilted_uT * tilted_uT;
  const double z = distance * distance / variance;
  return std::isfinite(z) ? z : std::numeric_limits<double>::max();
}

std::optional<MagnetometerEstimate> EllipseEstimator::estimate() const {
  if (!fit_) return std::nullopt;
  MagnetometerEstimate estimate;
  estimate.correction = correction_of(fit_->shape);
  const EllipseShape::Matrix covariance = stated_covariance(*fit_, cells_.cells(), 0);
  estimate.offset_std_uT.head<2>() = covariance.diagonal().head<2>().cwiseSqrt();
  estimate.matrix_std.setConstant(std::numeric_limits<double>::infinity());
  estimate.offset_std_uT.z() = std::numeric_limits<double>::infinity();
  estimate.residual_uT = fit_->residual_uT;
  estimate.field_uT = fit_->shape.radius_uT();
  estimate.heading_std_rad = worst_heading_std_rad(fit_->shape, covariance);
  estimate.samples = samples_;
  return estimate;
}

void EllipseEstimator::archive(Archive& archive) {
  archive.tag("ellipse_estimator 2");
  archive(cells_, fit_, held_out_, samples_);
}

}  // namespace navcal::calib
