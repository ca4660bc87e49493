// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/ellipsoid_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::calib {

Eigen::Matrix<double, 3, 6> EllipsoidShape::slope_of_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix<double, 3, 6> slope;
  slope << v.x(), 0, 0, 0, v.z(), v.y(),  //
      0, v.y(), 0, v.z(), 0, v.x(),       //
      0, 0, v.z(), v.y(), v.x(), 0;
  return slope;
}

EllipsoidShape EllipsoidShape::moved(const Vector& step) const {
  EllipsoidShape shape = *this;
  shape.centre_uT += step.head<3>();
  Eigen::Matrix3d change;
  change << step[3], step[8], step[7],  //
      step[8], step[4], step[6],        //
      step[7], step[6], step[5];
  shape.matrix_per_uT += change;
  shape.sine_of_dip += step[9];
  return shape;
}

double EllipsoidShape::radius_uT() const { return 1 / std::cbrt(matrix_per_uT.determinant()); }

bool EllipsoidShape::sane() const {
  constexpr double kLargest_uT = 1e4;
  if (!centre_uT.allFinite() || !matrix_per_uT.allFinite() || !(std::abs(sine_of_dip) < 1)) return false;
  if (centre_uT.cwiseAbs().maxCoeff() > kLargest_uT) return false;
  const Eigen::Vector3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix_per_uT, Eigen::EigenvaluesOnly).eigenvalues();
  return axes[0] > 1 / kLargest_uT && axes[0] > 0.1 * axes[2];
}

double relative_size_std(const EllipsoidShape& shape, const EllipsoidShape::Matrix& covariance) {
  // d ln(radius) = -tr(M^-1 dM) / 3
  const Eigen::Matrix3d inverse = shape.matrix_per_uT.inverse();
  Eigen::Matrix<double, 6, 1> trace;
  trace << inverse.diagonal(), 2 * inverse(1, 2), 2 * inverse(0, 2), 2 * inverse(0, 1);
  return std::sqrt(std::max(0., trace.dot(covariance.block<6, 6>(3, 3) * trace))) / 3;
}

Eigen::Matrix3d matrix_std(const EllipsoidShape& shape, const EllipsoidShape::Matrix& covariance, double size_uT,
                           bool size_known) {
  Eigen::Matrix<double, 6, 6> of_matrix = covariance.block<6, 6>(3, 3);
  if (!size_known) {
    // d (M / det(M)^(1/3)) = (dM - M tr(M^-1 dM) / 3) / det(M)^(1/3)
    const Eigen::Matrix3d inverse = shape.matrix_per_uT.inverse();
    const Eigen::Matrix3d& m = shape.matrix_per_uT;
    Eigen::Matrix<double, 6, 1> values, trace;
    values << m(0, 0), m(1, 1), m(2, 2), m(1, 2), m(0, 2), m(0, 1);
    trace << inverse.diagonal(), 2 * inverse(1, 2), 2 * inverse(0, 2), 2 * inverse(0, 1);
    const Eigen::Matrix<double, 6, 6> slope =
        Eigen::Matrix<double, 6, 6>::Identity() - values * trace.transpose() / 3;
    of_matrix = (slope * of_matrix * slope.transpose()).eval();
  }
  const Eigen::Matrix<double, 6, 1> std = size_uT * of_matrix.diagonal().cwiseMax(0).cwiseSqrt();
  Eigen::Matrix3d result;
  result << std[0], std[5], std[4],  //
      std[5], std[1], std[3],        //
      std[4], std[3], std[2];
  return result;
}

Eigen::Vector3d down_in_body(double roll_rad, double pitch_rad) {
  return {-std::sin(pitch_rad), std::sin(roll_rad) * std::cos(pitch_rad),
          std::cos(roll_rad) * std::cos(pitch_rad)};
}

double worst_raw_heading_error_rad(const EllipsoidShape& shape) {
  constexpr int kHeadings = 72;
  const double across = std::sqrt(1 - shape.sine_of_dip * shape.sine_of_dip);
  const Eigen::Matrix3d inverse = shape.matrix_per_uT.inverse();
  double worst = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector3d field(across * std::cos(heading), -across * std::sin(heading), shape.sine_of_dip);
    const Eigen::Vector3d measured = shape.centre_uT + inverse * field;
    const double raw = std::atan2(-measured.y(), measured.x());
    worst = std::max(worst, std::abs(std::remainder(raw - heading, 2 * std::numbers::pi)));
  }
  return worst;
}

double worst_heading_std_rad(const EllipsoidShape& shape, const EllipsoidError& error, double tilt_rad) {
  constexpr int kHeadings = 24;
  const double across = std::sqrt(1 - shape.sine_of_dip * shape.sine_of_dip);
  const Eigen::Matrix3d inverse = shape.matrix_per_uT.inverse();
  double worst = 0;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector3d field(across * std::cos(heading), -across * std::sin(heading), shape.sine_of_dip);
    const Eigen::Vector3d turned(-std::sin(heading), -std::cos(heading), 0);
    for (const auto& [roll, pitch] : {std::pair{0., 0.}, {1., 0.}, {-1., 0.}, {0., 1.}, {0., -1.}}) {
      const Eigen::Matrix3d body_from_level = (Eigen::AngleAxisd(-roll * tilt_rad, Eigen::Vector3d::UnitX()) *
                                               Eigen::AngleAxisd(-pitch * tilt_rad, Eigen::Vector3d::UnitY()))
                                                  .toRotationMatrix();
      const Eigen::Vector3d off_centre = inverse * (body_from_level * field);
      const Eigen::Vector3d direction = body_from_level * turned / across;
      EllipsoidShape::Vector row = EllipsoidShape::Vector::Zero();
      row.head<3>() = -shape.matrix_per_uT * direction;
      row.segment<6>(3) = EllipsoidShape::slope_of_matrix(off_centre).transpose() * direction;
      // The field, levelled by a tilt that is off, is as one that is turned back by that offset.
      const Eigen::Vector2d by_tilt =
          error.by_tilt_offset.transpose() * row + direction.cross(body_from_level * field).head<2>();
      worst = std::max(worst, row.dot(error.noise * row) + by_tilt.dot(error.tilt_offset_rad2 * by_tilt));
    }
  }
  return std::sqrt(worst);
}

}  // namespace navcal::calib
