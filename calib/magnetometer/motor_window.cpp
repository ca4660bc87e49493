// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/motor_window.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/symmetric_solve.h"
#include "base/vectors.h"

namespace navcal::calib {
namespace {

// Places of the unknowns: field at the window's beginning, hard iron, gyro bias, yaw gyro's scale, delay, soft
// iron.
constexpr int kFieldAt = 0, kHardAt = 3, kBiasAt = 6, kScaleAt = 9, kDelayAt = 10, kSoftAt = 11, kNuisances = 20;
constexpr int kSlope = kNuisances, kAll = kNuisances + 3;
constexpr int kIterations = 3;
/// Field values that the stated noise counts for beside the window's own.
constexpr double kPriorValues = 10;
/// Values that the fit of a window on a steady course uses up.
constexpr double kSpent = 12;
/// Information of the prior of k, A2/uT2: small enough not to matter, and large enough for an inverse.
constexpr double kSlopeInformation = 1e-3;

// Standard deviations of the priors, wide enough for any instrument that is not broken.
constexpr double kField_uT = 200, kBias_rad_s = 0.02, kScaleError = 0.05, kDelay_s = 0.15, kSoftIron = 0.1;
constexpr double kHard_uT = MotorFieldEvidence::kHardIron_uT;

using Rows = Eigen::Matrix<double, 3, kAll>;
using Information = Eigen::Matrix<double, kAll, kAll>;
using Unknowns = Eigen::Matrix<double, kAll, 1>;

/// Far above what the noise of the gyros turns and tilts a window by.
constexpr double kTurn_rad = 0.05, kTilt_rad = 0.05;

/// Rotation of a window about the vertical of its beginning, and its tilt away from that.
struct Motion {
  double turn_rad = 0, tilt_rad = 0;
  /// True when the rotation separates hard iron of an axis from the field of the Earth.
  [[nodiscard]] bool tells(Eigen::Index axis) const {
    return axis < 2 ? turn_rad > kTurn_rad : tilt_rad > kTilt_rad;
  }
};

Motion motion_of(const std::vector<MotorFieldReading>& window) {
  const Eigen::Matrix3d begin = Eigen::Quaterniond(window.front().turned).toRotationMatrix().transpose();
  Motion motion;
  for (const MotorFieldReading& reading : window) {
    const Eigen::Matrix3d turned = Eigen::Quaterniond(reading.turned).toRotationMatrix() * begin;
    motion.turn_rad = std::max(motion.turn_rad, std::abs(std::atan2(turned(0, 1), turned(0, 0))));
    motion.tilt_rad = std::max(motion.tilt_rad, std::acos(std::clamp(turned(2, 2), -1.0, 1.0)));
  }
  return motion;
}

/// `fixed_uT`: standard deviation of hard iron that the motion does not tell of.
Unknowns prior_variance(const Motion& motion, double fixed_uT) {
  constexpr double kFixedSoftIron = 0.001;
  Unknowns variance;
  variance.segment<3>(kFieldAt).setConstant(kField_uT * kField_uT);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double hard_uT = motion.tells(axis) ? kHard_uT : fixed_uT;
    variance[kHardAt + axis] = hard_uT * hard_uT;
  }
  variance.segment<3>(kBiasAt).setConstant(kBias_rad_s * kBias_rad_s);
  variance[kScaleAt] = kScaleError * kScaleError;
  variance[kDelayAt] = kDelay_s * kDelay_s;
  const double soft_iron = motion.tells(0) || motion.tells(2) ? kSoftIron : kFixedSoftIron;
  variance.segment<9>(kSoftAt).setConstant(soft_iron * soft_iron);
  variance.segment<3>(kSlope).setConstant(1 / kSlopeInformation);
  return variance;
}

/// Removes the information that the window alone gives on hard iron of `axis`.
void forget_hard_iron(MotorFieldEvidence& evidence, Eigen::Index axis) {
  const Eigen::Index dropped = 3 + axis;
  using Others = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> others;
  Others with, vector;
  for (Eigen::Index i = 0, row = 0; i < 6; ++i) {
    if (i == dropped) continue;
    for (Eigen::Index j = 0, column = 0; j < 6; ++j) {
      if (j != dropped) others(row, column++) = evidence.information(i, j);
    }
    with[row] = evidence.information(i, dropped);
    vector[row++] = evidence.vector[i];
  }
  others.diagonal().array() += kSlopeInformation * 1e-3;  // components that were dropped before have none
  const Others solved = base::solve_symmetric(others, with);
  evidence.information(dropped, dropped) = with.dot(solved);
  evidence.vector[dropped] = vector.dot(solved);
}

/// Point about which the model is linearised.
struct Point {
  Eigen::Vector3d field_uT, bias_rad_s = Eigen::Vector3d::Zero();
  double scale = 0;  ///< of the yaw gyro, less 1
};

/// Turn since the window's first reading by gyros that are corrected as the point says, and the integrals over
/// time by which it changes with bias and scale. The correction C of a turn R obeys dC/dt = -[R' e]x C for errors
/// e of the rates; its rates are small, so that the readings' own times are enough.
class Turning {
 public:
  Turning(const MotorFieldReading& first, const Point& point)
      : point_(point), begin_(Eigen::Quaterniond(first.turned).toRotationMatrix().transpose()), before_(first) {}

  void advance(const MotorFieldReading& reading) {
    const Eigen::Matrix3d measured = Eigen::Quaterniond(reading.turned).toRotationMatrix() * begin_;
    const double half_s = 0.5 * (reading.time_s - before_.time_s);
    const Eigen::Vector3d angle_rad = half_s * (measured_.transpose() * error_of(before_.rate_rad_s.z()) +
                                                measured.transpose() * error_of(reading.rate_rad_s.z()));
    if (const double size_rad = angle_rad.norm(); size_rad > 0) {
      correction_ = Eigen::AngleAxisd(-size_rad, angle_rad / size_rad).toRotationMatrix() * correction_;
    }
    const Eigen::Matrix3d turned = measured * correction_;
    bias_ += half_s * (turned_ + turned).transpose();
    scale_ += half_s * (turned_.row(2).transpose() * before_.rate_rad_s.z() +
                        turned.row(2).transpose() * reading.rate_rad_s.z());
    measured_ = measured;
    turned_ = turned;
    before_ = reading;
  }
  /// Derivatives of the reading by all unknowns.
  [[nodiscard]] Rows rows() const {
    const Eigen::Vector3d u = turned_ * point_.field_uT;
    Rows rows;
    rows.middleCols<3>(kFieldAt) = turned_;
    rows.middleCols<3>(kHardAt).setIdentity();
    rows.middleCols<3>(kBiasAt) = base::cross_product_matrix(u) * turned_ * bias_;
    rows.col(kScaleAt) = u.cross(turned_ * scale_);
    rows.col(kDelayAt) = before_.rate_rad_s.cross(u);
    for (int i = 0; i < 3; ++i) rows.middleCols<3>(kSoftAt + 3 * i) = Eigen::Matrix3d::Identity() * u[i];
    rows.middleCols<3>(kSlope) = Eigen::Matrix3d::Identity() * before_.current_A;
    return rows;
  }
  /// Right-hand side of the linear equations: the reading, plus the part that the point of linearisation has
  /// already put into the turn.
  [[nodiscard]] Eigen::Vector3d observed(const Rows& rows) const {
    return before_.field_body_uT + rows.middleCols<3>(kBiasAt) * point_.bias_rad_s +
           rows.col(kScaleAt) * point_.scale;
  }

 private:
  [[nodiscard]] Eigen::Vector3d error_of(double yaw_rate_rad_s) const {
    return point_.bias_rad_s + Eigen::Vector3d(0, 0, point_.scale * yaw_rate_rad_s);
  }

  Point point_;
  Eigen::Matrix3d begin_;
  MotorFieldReading before_;
  Eigen::Matrix3d measured_ = Eigen::Matrix3d::Identity(), correction_ = Eigen::Matrix3d::Identity(),
                  turned_ = Eigen::Matrix3d::Identity(), bias_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d scale_ = Eigen::Vector3d::Zero();
};

/// Kalman filter over the window, linearised about a point. The gyros' noise makes the field of the beginning
/// walk; everything else is constant.
class WindowFilter {
 public:
  WindowFilter(const MotorWindowNoise& noise, const Eigen::Vector3d& field_uT, const Unknowns& prior_variance)
      : noise_(noise), b_(field_uT), covariance_(prior_variance.asDiagonal()) {}

  void update(const Turning& turning, double duration_s) {
    const double walk_uT2 = noise_.rate_rad_sqrt_s * noise_.rate_rad_sqrt_s * duration_s;
    covariance_.topLeftCorner<3, 3>() +=
        walk_uT2 * (b_.squaredNorm() * Eigen::Matrix3d::Identity() - b_ * b_.transpose());
    const Rows rows = turning.rows();
    const Eigen::Matrix<double, kAll, 3> mixed = covariance_ * rows.transpose();
    Eigen::Matrix3d innovation = rows * mixed;
    innovation.diagonal().array() += noise_.field_uT * noise_.field_uT;
    const Eigen::Matrix3d inverse = innovation.inverse();
    const Eigen::Vector3d missed = turning.observed(rows) - rows * state_;
    const Eigen::Matrix<double, kAll, 3> gain = mixed * inverse;
    state_ += gain * missed;
    covariance_ -= gain * mixed.transpose();
    // Rounding must not make it lopsided: what is left is many orders below the priors.
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
    square_ += missed.dot(inverse * missed);
  }
  /// Variance of the residuals in units of what the noise says.
  [[nodiscard]] double excess(double values) const {
    return (kPriorValues + square_) / (kPriorValues + values - kSpent);
  }
  [[nodiscard]] Point found() const {
    return {state_.segment<3>(kFieldAt), state_.segment<3>(kBiasAt), state_[kScaleAt]};
  }
  [[nodiscard]] MotorFieldEvidence evidence(double values) const {
    MotorFieldEvidence evidence;
    const std::array<Eigen::Index, 6> places{kSlope, kSlope + 1, kSlope + 2, kHardAt, kHardAt + 1, kHardAt + 2};
    const MotorFieldEvidence::Information information = base::inverse_symmetric(covariance_(places, places));
    const MotorFieldEvidence::Vector best = state_(places);
    // Residuals that are larger than the noise says: everything is less certain.
    const double larger = std::max(1.0, excess(values));
    MotorFieldEvidence::Vector prior;
    prior << Eigen::Vector3d::Constant(kSlopeInformation), Eigen::Vector3d::Constant(1 / (kHard_uT * kHard_uT));
    evidence.information = information / larger;
    evidence.information.diagonal() -= prior / larger;
    evidence.vector = information * best / larger;
    evidence.square = square_ / larger + best.dot(evidence.vector);
    evidence.values = values;
    evidence.freedom = 6;
    evidence.variance_uT2 = larger * noise_.field_uT * noise_.field_uT;
    return evidence;
  }

 private:
  MotorWindowNoise noise_;
  Eigen::Vector3d b_;
  Unknowns state_ = Unknowns::Zero();
  Information covariance_;
  double square_ = 0;
};

WindowFilter filtered(const std::vector<MotorFieldReading>& window, const MotorWindowNoise& noise,
                      const Unknowns& variance, const Point& point) {
  WindowFilter filter(noise, point.field_uT, variance);
  Turning turning(window.front(), point);
  double before_s = window.front().time_s;
  for (const MotorFieldReading& reading : window) {
    turning.advance(reading);
    filter.update(turning, reading.time_s - before_s);
    before_s = reading.time_s;
  }
  return filter;
}

}  // namespace

double MotorFieldEvidence::mean_square_uT2(const Eigen::Vector3d& k) const {
  if (!(values > 0)) return 0;
  Eigen::Matrix3d of_iron = information.bottomRightCorner<3, 3>();
  of_iron.diagonal().array() += 1 / (kHardIron_uT * kHardIron_uT);
  const Eigen::Vector3d pull = vector.tail<3>() - information.bottomLeftCorner<3, 3>() * k;
  const Eigen::Vector3d iron = base::solve_symmetric(of_iron, pull);
  const double misfit =
      square - 2 * vector.head<3>().dot(k) + k.dot(information.topLeftCorner<3, 3>() * k) - pull.dot(iron);
  return std::max(0.0, misfit) * variance_uT2 / values;
}

MotorFieldEvidence evidence_of(const std::vector<MotorFieldReading>& window, const MotorWindowNoise& noise) {
  constexpr double kFixed_uT = 0.1;
  const double values = 3 * static_cast<double>(window.size());
  if (values <= kAll) return {};
  const Motion motion = motion_of(window);
  const Unknowns fixed = prior_variance(motion, kFixed_uT), open = prior_variance(motion, kHard_uT);
  Point point{window.front().field_body_uT};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    point = filtered(window, noise, fixed, point).found();
  }
  // The instrument's own noise by a first pass; the gyros' walk is as stated, since residuals hardly show it.
  MotorWindowNoise seen = noise;
  seen.field_uT *= std::sqrt(filtered(window, noise, open, point).excess(values));
  MotorFieldEvidence evidence = filtered(window, seen, open, point).evidence(values);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (motion.tells(axis)) continue;
    forget_hard_iron(evidence, axis);
    --evidence.freedom;
  }
  return evidence;
}

}  // namespace navcal::calib
