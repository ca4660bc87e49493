// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipse_estimator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>

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

std::optional<MagnetometerEstimate> EllipseEstimator::estimate() const {
  if (!fit_) return std::nullopt;
  return level_estimate(fit_->shape, stated_covariance(*fit_, cells_.cells(), 0), fit_->residual_uT, samples_);
}

void EllipseEstimator::archive(Archive& archive) {
  archive.tag("ellipse_estimator 3");
  archive(cells_, fit_, samples_);
}

}  // namespace navcal::calib
