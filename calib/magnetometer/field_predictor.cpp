// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/field_predictor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

constexpr double kMemory = 300;        // readings of which the noise is learnt
constexpr double kPriorReadings = 50;  // weight of the prior noise
constexpr double kTiltNoise_rad = 0.01;
constexpr std::uint64_t kLeastPredicted = 20;  // between two fits
constexpr std::uint64_t kFitShare = 20;        // a fit each time the readings grew by one in so many
constexpr double kWellKnown = 0.25;            // variance of the fit over that of the noise

double pooled(double believed, double weight, double found_square) {
  return std::sqrt((kPriorReadings * believed * believed + weight * found_square) / (kPriorReadings + weight));
}

}  // namespace

FieldCells<3, 6>::Cell cell_of(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  FieldCells<3, 6>::Cell cell;
  cell.count = 1;
  cell.mean << field_body_uT, Eigen::Vector3d::Zero();
  if (std::isfinite(roll_rad) && std::isfinite(pitch_rad)) cell.mean.tail<3>() = down_in_body(roll_rad, pitch_rad);
  return cell;
}

FieldPredictor::FieldPredictor(double noise_uT, const std::optional<KnownField>& known)
    : noise_uT_(noise_uT), belief_(SegmentBelief::about(known)) {}

SegmentNoise FieldPredictor::noise() const {
  SegmentNoise noise;
  noise.field_uT = pooled(noise_uT_, field_weight_, field_square_);
  noise.tilt_rad = pooled(kTiltNoise_rad, tilt_weight_, tilt_square_);
  return noise;
}

SegmentResidual FieldPredictor::residual(const PredictedReading& reading) const {
  SegmentNoise all = noise();
  all.tilt_error_rad = std::hypot(all.tilt_error_rad, reading.tilt_error_rad);
  return predicted_residual(shape_, reading.cell, all);
}

double FieldPredictor::surprise(const PredictedReading& reading) const {
  if (!fitted_) return 0;
  const SegmentResidual r = residual(reading);
  const double square = r.square(covariance_) / r.freedom;
  return std::isfinite(square) ? square : 0;
}

FieldPredictor::Exact FieldPredictor::exact(const PredictedReading& reading) const {
  if (!fitted_) return {};
  const SegmentResidual r = residual(reading);
  const Eigen::Matrix2d by_fit = r.slope * covariance_ * r.slope.transpose();
  bool known = by_fit(0, 0) < r.variance(0, 0);
  if (r.freedom == 2) known = known && by_fit(1, 1) < r.variance(1, 1);
  return {r.square() / r.freedom, known};
}

void FieldPredictor::learn_noise(const PredictedReading& reading) {
  if (!fitted_) return;
  const SegmentResidual r = residual(reading);
  const Eigen::Matrix2d by_fit = r.slope * covariance_ * r.slope.transpose();
  const auto learn = [](double& weight, double& mean, double square) {
    weight = std::min(weight + 1, kMemory);
    mean += (square - mean) / weight;
  };
  if (by_fit(0, 0) < kWellKnown * r.variance(0, 0)) {
    const double per_unit2 = 1 / r.slope.row(0).head<3>().squaredNorm();
    learn(field_weight_, field_square_, r.value[0] * r.value[0] * per_unit2);
  }
  if (r.freedom == 2 && by_fit(1, 1) < kWellKnown * r.variance(1, 1)) {
    const double across2 = std::max(0.05, 1 - shape_.sine_of_dip * shape_.sine_of_dip);
    const double by_field = field_weight_ > 0 ? field_square_ * r.slope.row(1).head<3>().squaredNorm() : 0;
    learn(tilt_weight_, tilt_square_, std::max(0.0, r.value[1] * r.value[1] - by_field) / across2);
  }
}

void FieldPredictor::fit(const EllipsoidCells& cells) {
  next_fit_ = samples_ + std::max(kLeastPredicted, samples_ / kFitShare);
  const EllipsoidCells* const all[] = {&cells};
  const bool early = samples_ < 4 * kFirstFit;  // early shapes are poor beginnings
  if (const auto fit = fit_segments(all, noise(), belief_, fitted_ && !early ? &shape_ : nullptr)) set_fit(*fit);
}

void FieldPredictor::set_fit(const SegmentsFit& fit) {
  fitted_ = true;
  shape_ = fit.shape;
  covariance_ = fit.covariance.topLeftCorner<EllipsoidShape::kParameters, EllipsoidShape::kParameters>();
}

void FieldPredictor::archive(Archive& archive) {
  archive.tag("field_predictor 1");
  archive(fitted_, shape_, covariance_, field_weight_, field_square_, tilt_weight_, tilt_square_, samples_,
          next_fit_);
}

}  // namespace navcal::calib
