#include "calib/ellipsoid_estimator.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace navcal::calib {
namespace {

constexpr double kCellSize_uT = 0.7;
constexpr std::uint64_t kFirstFit = 40;  // readings
constexpr int kMostIterations = 50;      // ten or so where the data determine the shape
constexpr double kJudged = 50;           // readings held against a fit before it may find others surprising
constexpr double kPriorReadings = 50;    // what the noise believed beforehand is worth

}  // namespace

EllipsoidEstimator::EllipsoidEstimator(const Parameters& parameters)
    : parameters_(parameters), cells_(kCellSize_uT), tiltless_(kCellSize_uT) {}

EllipsoidCells EllipsoidEstimator::cells() const {
  EllipsoidCells both = cells_.cells();
  both.insert(both.end(), tiltless_.cells().begin(), tiltless_.cells().end());
  return both;
}

EllipsoidNoise EllipsoidEstimator::noise() const {
  const auto pooled = [](double believed, double weight, double found_square) {
    return std::sqrt((kPriorReadings * believed * believed + weight * found_square) / (kPriorReadings + weight));
  };
  const double after = held_out_.after_uT();
  EllipsoidNoise noise;
  noise.field_uT = pooled(parameters_.noise_uT, held_out_.weight(), after * after);
  // Neighbouring cells have the same lag and accelerations: all that tilt tells is worth so many of its readings.
  constexpr double kIndependentTilts = 100;
  const double shared = std::max(1.0, static_cast<double>(cells_.cells().size()) / kIndependentTilts);
  noise.tilt_rad = std::sqrt(shared) * pooled(parameters_.tilt_noise_rad, tilt_weight_, tilt_square_);
  return noise;
}

void EllipsoidEstimator::learn_noise(const Eigen::Vector3d& field_uT, const Eigen::Vector3d& down) {
  constexpr double kMemory = 300;  // readings
  const Departure d = departure(field_uT, down);
  // A fit that knows nothing of this direction yet says nothing by being off.
  if (d.fit_variance > 0.25 * d.noise_variance) return;
  held_out_.update(field_uT.norm(), fit_->shape.radius_uT() * d.size);
  const double across = std::max(0.1, 1 - fit_->shape.sine_of_dip * fit_->shape.sine_of_dip);
  if (down.isZero(0)) return;
  tilt_weight_ = std::min(tilt_weight_ + 1, kMemory);
  const double square = std::max(0.0, d.dip * d.dip - d.noise_variance) / across;
  tilt_square_ += (square - tilt_square_) / tilt_weight_;
}

EllipsoidEstimator::Departure EllipsoidEstimator::departure(const Eigen::Vector3d& field_uT,
                                                            const Eigen::Vector3d& down) const {
  const Eigen::Matrix3d& m = fit_->shape.matrix_per_uT;
  const Eigen::Vector3d unit = fit_->shape.unit_field(field_uT);
  const Eigen::Vector3d direction = unit.normalized();
  EllipsoidShape::Vector row = EllipsoidShape::Vector::Zero();
  row.head<3>() = -m * direction;
  row.segment<6>(3) = EllipsoidShape::slope_of_matrix(field_uT - fit_->shape.centre_uT).transpose() * direction;
  const double noise_uT = noise().field_uT;
  Departure d;
  d.size = unit.norm() - 1;
  d.dip = down.dot(unit) - fit_->shape.sine_of_dip;
  d.noise_variance = noise_uT * noise_uT * (m * direction).squaredNorm();
  d.fit_variance = row.dot(fit_->covariance * row);
  return d;
}

void EllipsoidEstimator::update(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad) {
  FieldCells<3, 6>::Vector reading;
  const bool tilt_known = std::isfinite(roll_rad) && std::isfinite(pitch_rad);
  reading << field_body_uT, Eigen::Vector3d::Zero();
  if (tilt_known) reading.tail<3>() = down_in_body(roll_rad, pitch_rad);
  if (!reading.allFinite() || field_body_uT.cwiseAbs().maxCoeff() > kHighestField_uT) return;
  if (fit_) learn_noise(field_body_uT, reading.tail<3>());
  (tilt_known ? cells_ : tiltless_).add(reading);
  ++samples_;
  if (samples_ < kFirstFit) return;
  // As with the ellipse: early beginnings are poor ones.
  if (std::has_single_bit(samples_ / kFirstFit) && samples_ % kFirstFit == 0) begin();
  if (samples_ % static_cast<std::uint64_t>(parameters_.slice_samples) != 0) return;
  if (!fit_) begin();
  if (fit_) fit_ = improve(*fit_, cells(), noise(), {parameters_.known, parameters_.soft_iron_std});
}

void EllipsoidEstimator::begin() {
  fit_.reset();
  if (const auto shape = starting_sphere(cells(), {parameters_.known, parameters_.soft_iron_std})) {
    fit_.emplace();
    fit_->shape = *shape;
  }
}

void EllipsoidEstimator::settle() {
  begin();
  for (int i = 0; fit_ && !fit_->settled && i < kMostIterations; ++i) {
    fit_ = improve(*fit_, cells(), noise(), {parameters_.known, parameters_.soft_iron_std});
  }
}

double EllipsoidEstimator::surprise(const Eigen::Vector3d& field_body_uT) const {
  if (!fit_ || held_out_.weight() < kJudged) return 0;
  const Departure d = departure(field_body_uT, Eigen::Vector3d::Zero());
  const double error = parameters_.model_error * (1 + fit_->shape.centre_uT.norm() / fit_->shape.radius_uT());
  const double z = d.size * d.size / (d.noise_variance + d.fit_variance + error * error);
  return std::isfinite(z) ? z : std::numeric_limits<double>::max();
}

std::optional<MagnetometerEstimate> EllipsoidEstimator::estimate() const {
  if (!fit_) return std::nullopt;
  const double size_uT = parameters_.known ? parameters_.known->magnitude_uT : fit_->shape.radius_uT();
  MagnetometerEstimate estimate;
  estimate.correction.offset_uT = fit_->shape.centre_uT;
  estimate.correction.matrix = size_uT * fit_->shape.matrix_per_uT;
  estimate.offset_std_uT = fit_->covariance.diagonal().head<3>().cwiseSqrt();
  estimate.residual_uT = noise().field_uT;
  estimate.field_uT = size_uT;
  estimate.heading_std_rad = worst_heading_std_rad(fit_->shape, fit_->covariance, parameters_.expected_tilt_rad);
  estimate.samples = samples_;
  return estimate;
}

void EllipsoidEstimator::archive(Archive& archive) {
  archive.tag("ellipsoid_estimator 1");
  archive(cells_, tiltless_, fit_, held_out_, tilt_square_, tilt_weight_, samples_);
}

}  // namespace navcal::calib
