// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_noise.h"

#include <algorithm>
#include <cmath>

#include "calib/magnetometer/ellipsoid_residual.h"

namespace navcal::calib {
namespace {

constexpr double kUnit_uT = 50;                 // of the monomials, so that they are of the order of one
constexpr double kLeastBlocks = 30;             // fewer do not tell a variance
constexpr double kAbsorbed = 7;                 // block sums that the parameters of a line make small
constexpr double kEllipsoidPriorReadings = 50;  // weight of the prior noise

}  // namespace

template <int Size>
void ResidualBlocks::Sums<Size>::add(const Vector& monomials) {
  for (std::size_t i = 0; i < scales.size(); ++i) {
    Scale& scale = scales[i];
    scale.block += monomials;
    if (++scale.in_block < kLengths[i]) continue;
    scale.square += scale.block * scale.block.transpose();
    ++scale.blocks;
    scale.in_block = 0;
    scale.block.setZero();
  }
}

template <int Size>
double ResidualBlocks::Sums<Size>::inflation(const Vector& coefficients) const {
  const auto variance = [&](std::size_t i) {
    return coefficients.dot(scales[i].square * coefficients) /
           (static_cast<double>(scales[i].blocks) * kLengths[i]);
  };
  if (scales[0].blocks == 0) return 1;
  const double single = variance(0);
  double worst = 1;
  for (std::size_t i = 1; i < scales.size() && single > 0; ++i) {
    const auto blocks = static_cast<double>(scales[i].blocks);
    if (blocks < kLeastBlocks) break;
    // One standard deviation of the estimate is subtracted, so that the largest of several is not too large by
    // chance.
    const double chance = 1 - std::sqrt(2 / blocks);
    worst = std::max(worst, chance * blocks / (blocks - kAbsorbed) * variance(i) / single);
  }
  return worst;
}

void ResidualBlocks::update(const Eigen::Vector3d& field_uT, const Eigen::Vector3d& down) {
  const Eigen::Vector3d m = field_uT / kUnit_uT;
  Eigen::Matrix<double, 10, 1> size;
  size << m.cwiseProduct(m), 2 * m.y() * m.z(), 2 * m.x() * m.z(), 2 * m.x() * m.y(), m, 1;
  size_.add(size);
  if (down.isZero(0)) return;
  Eigen::Matrix<double, 13, 1> dip;
  dip << m.x() * down, m.y() * down, m.z() * down, down, 1;
  dip_.add(dip);
}

double ResidualBlocks::size_inflation(const EllipsoidShape& shape) const {
  // (|u|^2 - 1) / 2 is |u| - 1 to first order.
  const Eigen::Matrix3d m = kUnit_uT * shape.matrix_per_uT;
  const Eigen::Matrix3d a = m * m;
  const Eigen::Vector3d c = shape.centre_uT / kUnit_uT;
  Eigen::Matrix<double, 10, 1> coefficients;
  coefficients << a.diagonal(), a(1, 2), a(0, 2), a(0, 1), -2 * (a * c), c.dot(a * c) - 1;
  return size_.inflation(coefficients / 2);
}

double ResidualBlocks::dip_inflation(const EllipsoidShape& shape) const {
  const Eigen::Matrix3d m = kUnit_uT * shape.matrix_per_uT;
  Eigen::Matrix<double, 13, 1> coefficients;
  coefficients << m.col(0), m.col(1), m.col(2), -m * (shape.centre_uT / kUnit_uT), -shape.sine_of_dip;
  return dip_.inflation(coefficients);
}

void ResidualBlocks::archive(Archive& archive) {
  archive.tag("residual_blocks 1");
  archive(size_, dip_);
}

namespace {

/// Sums over the readings of what each line departs from the fit. An outlier counts for what is still plausible by
/// `so_far`.
struct Departures {
  double size_count = 0, size_square = 0;                  ///< of the field's size, uT
  double dip_count = 0, dip_square = 0, dip_by_field = 0;  ///< of the dip; what 1 uT of noise adds to its square
};

Departures departures_of(const EllipsoidShape& shape, const EllipsoidCells& cells, const EllipsoidNoise& so_far) {
  Departures sums;
  for (const auto& cell : cells) {
    const EllipsoidResidual r = residual_of(shape, cell, so_far);
    const double weight = cell.count * outlier_weight(r.square());
    const auto within = [&](const Eigen::Matrix<double, 6, 1>& slope) {
      return slope.dot(cell.scatter * slope) / cell.count;
    };
    Eigen::Matrix<double, 6, 1> slope;
    slope << r.by_field.row(0).transpose(), Eigen::Vector3d::Zero();
    sums.size_count += weight;
    sums.size_square += weight * (r.value[0] * r.value[0] + within(slope)) / r.by_field.row(0).squaredNorm();
    if (!r.tilt_known) continue;
    slope << r.by_field.row(1).transpose(), shape.matrix_per_uT * (cell.mean.head<3>() - shape.centre_uT);
    sums.dip_count += weight;
    sums.dip_square += weight * (r.value[1] * r.value[1] + within(slope));
    sums.dip_by_field += weight * r.by_field.row(1).squaredNorm();
  }
  return sums;
}

/// Standard deviation with the believed one as kEllipsoidPriorReadings of the readings.
double pooled_noise(double square, double count, double believed) {
  const double prior = kEllipsoidPriorReadings * believed * believed;
  return std::sqrt((prior + square * count / std::max(1., count - 5)) / (kEllipsoidPriorReadings + count));
}

}  // namespace

EllipsoidNoise fitted_noise(const EllipsoidShape& shape, const EllipsoidCells& cells, const ResidualBlocks& blocks,
                            const EllipsoidNoise& believed, const EllipsoidNoise& so_far) {
  constexpr int kRounds = 2;  // outliers depend on the noise that is sought
  const double across2 = std::max(0.01, 1 - shape.sine_of_dip * shape.sine_of_dip);
  EllipsoidNoise noise;
  noise.field_uT = so_far.field_uT;
  noise.tilt_rad = so_far.tilt_rad;
  double dip_by_field = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Departures sums = departures_of(shape, cells, noise);
    noise.field_uT = pooled_noise(sums.size_square, sums.size_count, believed.field_uT);
    const double tilt2 =
        std::max(0., sums.dip_square - noise.field_uT * noise.field_uT * sums.dip_by_field) / across2;
    // Never less than the instrument's own: where the tilt hardly changes, a shape that follows its noise fits
    // best.
    noise.tilt_rad = std::max(believed.tilt_rad, pooled_noise(tilt2, sums.dip_count, believed.tilt_rad));
    dip_by_field = sums.dip_count > 0 ? sums.dip_by_field / sums.dip_count : 0;
  }
  noise.field_inflation = blocks.size_inflation(shape);
  if (!(dip_by_field > 0)) return noise;
  // Residuals of the dip that neighbours share are those of the tilt, less the part that the field's noise
  // explains.
  const double by_field = noise.field_uT * noise.field_uT * dip_by_field,
               by_tilt = noise.tilt_rad * noise.tilt_rad * across2;
  const double together = blocks.dip_inflation(shape) * (by_field + by_tilt) - noise.field_inflation * by_field;
  noise.tilt_inflation = std::max(1., together / std::max(by_tilt, 1e-12));
  return noise;
}

}  // namespace navcal::calib
