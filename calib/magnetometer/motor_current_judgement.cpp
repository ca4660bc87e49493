// SPDX-License-Identifier: Apache-2.0
// What the windows of MotorCurrent say together.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "base/symmetric_solve.h"
#include "calib/magnetometer/motor_current.h"

namespace navcal::calib {
namespace {

/// Windows of which a variance of 1 is assumed beforehand.
constexpr double kPriorWindows = 2;
/// An axis known no better than this share of the whole, or this much, is not.
constexpr double kAccurate = 0.1, kAccurate_uT_per_A = 0.1;
/// Chi-square of three values that are zero exceeds this in one case of a thousand.
constexpr double kSeen = 16.3;
/// A direction of k with less information than this is not determined at all, A2/uT2.
constexpr double kLeastInformation = 1e-3;

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

}  // namespace

std::optional<MotorCurrent::Estimate> MotorCurrent::estimate() const {
  using Information = MotorFieldEvidence::Information;
  using Vector = MotorFieldEvidence::Vector;
  constexpr double kIronInformation = 1 / (MotorFieldEvidence::kHardIron_uT * MotorFieldEvidence::kHardIron_uT);
  Information information = Information::Zero();
  information.bottomRightCorner<3, 3>() = kIronInformation * Eigen::Matrix3d::Identity();
  Vector vector = Vector::Zero();
  double freedom = 0;
  for (const MotorFieldEvidence& window : windows_) {
    information += window.information;
    vector += window.vector;
    freedom += window.freedom;
  }
  const Eigen::Matrix3d of_slope = information.topLeftCorner<3, 3>();
  if (windows_.empty() || !(of_slope.selfadjointView<Eigen::Lower>().eigenvalues()[0] > kLeastInformation)) {
    return std::nullopt;
  }
  const Information covariance = base::inverse_symmetric(information);
  const Vector found = covariance * vector;
  // Each window's gradient at the common solution has its information as covariance, if there is only noise.
  double chi_square = 0;
  for (const MotorFieldEvidence& window : windows_) {
    const Vector gradient = window.vector - window.information * found;
    const Information firm = window.information + kLeastInformation * Information::Identity();
    chi_square += gradient.dot(Vector(base::solve_symmetric(firm, gradient)));
  }
  const double prior = 3 * kPriorWindows;
  const double spread = std::max(1.0, (chi_square + prior) / (std::max(freedom - 6, 0.0) + prior));
  return Estimate{found.head<3>(), spread * covariance.topLeftCorner<3, 3>()};
}

Judgement MotorCurrent::judgement() const {
  const std::string manoeuvre =
      "change the shaft speed on a steady course, up and down by half of it, several times, ten seconds each";
  Judgement judgement;
  judgement.samples = readings_;
  judgement.condition = std::numeric_limits<double>::infinity();
  judgement.held_out_before = comparison_.before_rms();
  judgement.held_out_after = comparison_.estimate_rms();
  if (!current_seen_) return judgement.refused("the motor card reports no current", "");
  const auto found = estimate();
  if (!found)
    return judgement.refused("the motor's current has hardly changed while the field was read", manoeuvre);
  const Eigen::Vector3d eigenvalues = found->covariance.selfadjointView<Eigen::Lower>().eigenvalues();
  judgement.condition = eigenvalues[2] / eigenvalues[0];
  const double std = std::sqrt(found->covariance.diagonal().maxCoeff());
  const double limit = std::max(kAccurate_uT_per_A, kAccurate * found->slope_uT_per_A.norm());
  judgement.coverage = std::min(1.0, limit * limit / (std * std));
  if (std > limit) {
    return judgement.refused("the field per ampere is uncertain by " + two_digits(std) + " uT/A", manoeuvre);
  }
  const Eigen::Vector3d weighted = base::solve_symmetric(found->covariance, found->slope_uT_per_A);
  const double chi_square = found->slope_uT_per_A.dot(weighted);
  if (chi_square < kSeen) {
    return judgement.refused(
        "no field of the motor's current is seen beyond the error of " + two_digits(std) + " uT/A", "");
  }
  judgement.accepted = true;
  return judgement;
}

}  // namespace navcal::calib
