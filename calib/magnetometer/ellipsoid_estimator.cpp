// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_estimator.h"

#include <Eigen/Dense>
#include <bit>
#include <cmath>

#include "calib/magnetometer/ellipsoid_judgement.h"
#include "calib/magnetometer/field_cells.h"

namespace navcal::calib {
namespace {

constexpr std::uint64_t kFirstEllipsoidFit = 40;  // readings
constexpr int kMostEllipsoidIterations = 50;      // ten or so where the data determine the shape

}  // namespace

EllipsoidEstimator::EllipsoidEstimator(const Parameters& parameters)
    : parameters_(parameters), cells_(kCellSize_uT), tiltless_(kCellSize_uT) {
  noise_ = believed();
}

EllipsoidCells EllipsoidEstimator::cells() const {
  EllipsoidCells both = cells_.cells();
  both.insert(both.end(), tiltless_.cells().begin(), tiltless_.cells().end());
  return both;
}

void EllipsoidEstimator::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  FieldCells<3, 6>::Vector reading;
  const bool tilt_known = std::isfinite(roll_rad) && std::isfinite(pitch_rad);
  reading << field_body_uT, Eigen::Vector3d::Zero();
  if (tilt_known) reading.tail<3>() = down_in_body(roll_rad, pitch_rad);
  if (!reading.allFinite() || field_body_uT.cwiseAbs().maxCoeff() > kHighestField_uT) return;
  (tilt_known ? cells_ : tiltless_).add(reading);
  blocks_.update(field_body_uT, reading.tail<3>());
  ++samples_;
  if (samples_ < kFirstEllipsoidFit) return;
  // Early initial guesses are poor, so the fit starts again at 2, 4, 8, ... times the first number of readings,
  // as for the ellipse.
  if (std::has_single_bit(samples_ / kFirstEllipsoidFit) && samples_ % kFirstEllipsoidFit == 0) begin();
  if (samples_ % static_cast<std::uint64_t>(parameters_.slice_samples) != 0) return;
  if (!fit_) begin();
  if (fit_) iterate();
}

void EllipsoidEstimator::iterate() {
  const EllipsoidShape before = fit_->shape;
  const EllipsoidCells all = cells();
  fit_ = improve(*fit_, all, noise_, {parameters_.known, parameters_.soft_iron_std});
  // Scatter about a shape on its way would pass for noise, and what it then weighs little would keep it there.
  const Eigen::Vector3d moved = (fit_->shape.centre_uT - before.centre_uT).cwiseAbs();
  const Eigen::Vector3d std = fit_->covariance.diagonal().head<3>().cwiseSqrt();
  if (fit_->damping == 0 && (moved.array() < 0.3 * std.array()).all())
    noise_ = fitted_noise(fit_->shape, all, blocks_, believed(), noise_);
}

EllipsoidNoise EllipsoidEstimator::believed() const {
  EllipsoidNoise noise;
  noise.field_uT = parameters_.noise_uT;
  noise.tilt_rad = parameters_.tilt_noise_rad;
  return noise;
}

void EllipsoidEstimator::begin() {
  fit_.reset();
  noise_ = believed();
  if (const auto shape = starting_sphere(cells(), {parameters_.known, parameters_.soft_iron_std})) {
    fit_.emplace();
    fit_->shape = *shape;
  }
}

void EllipsoidEstimator::absorb(const EllipsoidEstimator& other) {
  for (const auto& cell : other.cells_.cells()) cells_.add(cell);
  for (const auto& cell : other.tiltless_.cells()) tiltless_.add(cell);
  samples_ += other.samples_;
}

void EllipsoidEstimator::settle() {
  begin();
  if (!fit_) return;
  const EllipsoidCells all = cells();
  // Weights and shape in turn; three rounds change either by less than a tenth of its error.
  for (int round = 0; round < 3; ++round) {
    fit_->settled = false;
    for (int i = 0; !fit_->settled && i < kMostEllipsoidIterations; ++i)
      fit_ = improve(*fit_, all, noise_, {parameters_.known, parameters_.soft_iron_std});
    noise_ = fitted_noise(fit_->shape, all, blocks_, believed(), noise_);
  }
  fit_->settled = false;
  for (int i = 0; !fit_->settled && i < kMostEllipsoidIterations; ++i)
    fit_ = improve(*fit_, all, noise_, {parameters_.known, parameters_.soft_iron_std});
}

EllipsoidError EllipsoidEstimator::error() const {
  return fit_ ? stated_error(*fit_, cells(), noise_, 0) : EllipsoidError{};
}

std::optional<MagnetometerEstimate> EllipsoidEstimator::estimate() const {
  if (!fit_) return std::nullopt;
  const double size_uT = parameters_.known ? parameters_.known->magnitude_uT : fit_->shape.radius_uT();
  MagnetometerEstimate estimate;
  estimate.correction.offset_uT = fit_->shape.centre_uT;
  estimate.correction.matrix = size_uT * fit_->shape.matrix_per_uT;
  const EllipsoidError error = this->error();
  const EllipsoidShape::Matrix stated = error.covariance();
  estimate.offset_std_uT = stated.diagonal().head<3>().cwiseSqrt();
  estimate.matrix_std = matrix_std(fit_->shape, stated, size_uT, parameters_.known.has_value());
  if (parameters_.known) {
    estimate.field_scale = fit_->shape.radius_uT() / size_uT;
    estimate.field_scale_std = estimate.field_scale * relative_size_std(fit_->shape, stated);
  }
  estimate.residual_uT = noise_.field_uT;
  estimate.field_uT = size_uT;
  estimate.heading_std_rad = worst_heading_std_rad(fit_->shape, error, parameters_.expected_tilt_rad);
  estimate.samples = samples_;
  return estimate;
}

void EllipsoidEstimator::archive(Archive& archive) {
  archive.tag("ellipsoid_estimator 3");
  archive(cells_, tiltless_, fit_, blocks_, noise_, samples_);
}

}  // namespace navcal::calib
