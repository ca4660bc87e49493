#include "calib/motor_window.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

// Places of the unknowns: field at the window's beginning, hard iron, gyro bias, yaw gyro's scale, delay, soft
// iron.
constexpr int kField = 0, kHard = 3, kBias = 6, kScale = 9, kDelay = 10, kSoft = 11, kNuisances = 20;
constexpr int kSlope = kNuisances, kAll = kNuisances + 3;
constexpr int kIterations = 3;
/// Hard iron by which readings are shifted to see what it does to k.
constexpr double kShift_uT = 5;
/// Field values that the stated noise counts for beside the window's own.
constexpr double kPriorValues = 10;
/// Values that the fit of a window on a steady course uses up.
constexpr double kSpent = 12;
/// Of the prior of k, A2/uT2: too little to matter, enough to have an inverse.
constexpr double kSlopeInformation = 1e-3;

// Standard deviations of the priors, wide enough for any instrument that is not broken.
constexpr double kField_uT = 200, kHard_uT = 60, kBias_rad_s = 0.02, kScaleError = 0.05, kDelay_s = 0.15,
                 kSoftIron = 0.1;

using Rows = Eigen::Matrix<double, 3, kAll>;
using Information = Eigen::Matrix<double, kAll, kAll>;
using Unknowns = Eigen::Matrix<double, kAll, 1>;

Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

/// Standard deviations of hard and soft iron where a window is not fit to learn them.
constexpr double kFixed_uT = 0.1, kFixedSoftIron = 0.001;

Unknowns prior_variance(const std::vector<MotorFieldReading>& window) {
  Unknowns variance;
  variance.segment<3>(kField).setConstant(kField_uT * kField_uT);
  variance.segment<3>(kHard).setConstant(kHard_uT * kHard_uT);
  variance.segment<3>(kBias).setConstant(kBias_rad_s * kBias_rad_s);
  variance[kScale] = kScaleError * kScaleError;
  variance[kDelay] = kDelay_s * kDelay_s;
  variance.segment<9>(kSoft).setConstant(kSoftIron * kSoftIron);
  variance.segment<3>(kSlope).setConstant(1 / kSlopeInformation);
  // Hard and soft iron differ from the field of the Earth only where the vehicle turns or tilts. On a steady
  // course the gyros' noise alone would seem to tell them apart: a constant fits better than a field turned by
  // noise.
  constexpr double kTurn_rad = 0.2, kTilt_rad = 0.2;
  const Eigen::Matrix3d begin = Eigen::Quaterniond(window.front().turned).toRotationMatrix().transpose();
  double turn_rad = 0, tilt_rad = 0;
  for (const MotorFieldReading& reading : window) {
    const Eigen::Matrix3d turned = Eigen::Quaterniond(reading.turned).toRotationMatrix() * begin;
    turn_rad = std::max(turn_rad, std::abs(std::atan2(turned(0, 1), turned(0, 0))));
    tilt_rad = std::max(tilt_rad, std::acos(std::clamp(turned(2, 2), -1.0, 1.0)));
  }
  if (turn_rad < kTurn_rad) variance.segment<2>(kHard).setConstant(kFixed_uT * kFixed_uT);
  if (tilt_rad < kTilt_rad) variance[kHard + 2] = kFixed_uT * kFixed_uT;
  if (turn_rad < kTurn_rad || tilt_rad < kTilt_rad) {
    variance.segment<9>(kSoft).setConstant(kFixedSoftIron * kFixedSoftIron);
  }
  return variance;
}

/// About which the model is linearised.
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
    rows.middleCols<3>(kField) = turned_;
    rows.middleCols<3>(kHard).setIdentity();
    rows.middleCols<3>(kBias) = cross(u) * turned_ * bias_;
    rows.col(kScale) = u.cross(turned_ * scale_);
    rows.col(kDelay) = before_.rate_rad_s.cross(u);
    for (int i = 0; i < 3; ++i) rows.middleCols<3>(kSoft + 3 * i) = Eigen::Matrix3d::Identity() * u[i];
    rows.middleCols<3>(kSlope) = Eigen::Matrix3d::Identity() * before_.current_A;
    return rows;
  }
  /// What the rows times the unknowns are to give: the reading, but for what the point has taken into the turn.
  [[nodiscard]] Eigen::Vector3d observed(const Rows& rows) const {
    return before_.field_body_uT + rows.middleCols<3>(kBias) * point_.bias_rad_s + rows.col(kScale) * point_.scale;
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
    return {state_.segment<3>(kField), state_.segment<3>(kBias), state_[kScale]};
  }
  [[nodiscard]] MotorFieldEvidence evidence(double values) const {
    MotorFieldEvidence evidence;
    const Eigen::Matrix3d information = covariance_.bottomRightCorner<3, 3>().inverse();
    const Eigen::Vector3d best = state_.tail<3>();
    // Residuals that are larger than the noise says: everything is less certain.
    const double larger = std::max(1.0, excess(values));
    evidence.information = (information - kSlopeInformation * Eigen::Matrix3d::Identity()) / larger;
    evidence.vector = information * best / larger;
    evidence.square = square_ / larger + best.dot(evidence.vector);
    evidence.values = values;
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
  const double misfit = square - 2 * vector.dot(k) + k.dot(information * k);
  return values > 0 ? std::max(0.0, misfit) * variance_uT2 / values : 0;
}

MotorFieldEvidence evidence_of(const std::vector<MotorFieldReading>& window, const MotorWindowNoise& noise) {
  const double values = 3 * static_cast<double>(window.size());
  if (values <= kAll) return {};
  const Unknowns variance = prior_variance(window);
  Point point{window.front().field_body_uT};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    point = filtered(window, noise, variance, point).found();
  }
  // The instrument's own noise by a first pass; the gyros' walk is as stated, since residuals hardly show it.
  MotorWindowNoise seen = noise;
  seen.field_uT *= std::sqrt(filtered(window, noise, variance, point).excess(values));
  MotorFieldEvidence evidence = filtered(window, seen, variance, point).evidence(values);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Point shifted = point;
    shifted.field_uT[axis] -= kShift_uT;
    std::vector<MotorFieldReading> without = window;
    for (MotorFieldReading& reading : without) reading.field_body_uT[axis] -= kShift_uT;
    const MotorFieldEvidence other = filtered(without, seen, variance, shifted).evidence(values);
    evidence.by_hard_iron.col(axis) = (other.vector - evidence.vector) / kShift_uT;
  }
  return evidence;
}

}  // namespace navcal::calib
