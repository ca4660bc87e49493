// What the windows of MotorCurrent say together.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "calib/motor_current.h"

namespace navcal::calib {
namespace {

/// Windows of which a variance of 1 is assumed beforehand.
constexpr double kPriorWindows = 2;
/// An axis known no better than this share of the whole, or this much, is not.
constexpr double kAccurate = 0.1, kAccurate_uT_per_A = 0.1;
/// Chi-square of three values that are zero exceeds this in one case of a thousand.
constexpr double kSeen = 16.3;
/// Standard deviation of hard iron, which windows on a steady course do not tell: the torque of the shaft rolls
/// the vehicle when the current changes, and the field that turns with it is that of the Earth alone.
constexpr double kHardIron_uT = 15;
/// A direction of k with less information than this is not determined at all, A2/uT2.
constexpr double kLeastInformation = 1e-3;

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

}  // namespace

std::optional<MotorCurrent::Estimate> MotorCurrent::estimate() const {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_hard_iron = Eigen::Matrix3d::Zero();
  for (const MotorFieldEvidence& window : windows_) {
    information += window.information;
    vector += window.vector;
    by_hard_iron += window.by_hard_iron;
  }
  if (windows_.empty() || !(information.selfadjointView<Eigen::Lower>().eigenvalues()[0] > kLeastInformation)) {
    return std::nullopt;
  }
  Estimate estimate;
  estimate.covariance = information.inverse();
  estimate.slope_uT_per_A = estimate.covariance * vector;
  // Each window's gradient at the common k has its information as covariance, if there is nothing but noise.
  double chi_square = 0;
  for (const MotorFieldEvidence& window : windows_) {
    const Eigen::Vector3d gradient = window.vector - window.information * estimate.slope_uT_per_A;
    const Eigen::Matrix3d firm = window.information + kLeastInformation * Eigen::Matrix3d::Identity();
    chi_square += gradient.dot(firm.ldlt().solve(gradient));
  }
  const double freedom = 3 * (static_cast<double>(windows_.size()) - 1), prior = 3 * kPriorWindows;
  const Eigen::Matrix3d by_iron = kHardIron_uT * estimate.covariance * by_hard_iron;
  estimate.covariance *= std::max(1.0, (chi_square + prior) / (freedom + prior));
  estimate.covariance += by_iron * by_iron.transpose();
  return estimate;
}

Judgement MotorCurrent::judgement() const {
  const std::string manoeuvre =
      "change the shaft speed on a steady course, up and down by half of it, several times, ten seconds each";
  Judgement judgement;
  judgement.samples = readings_;
  judgement.condition = std::numeric_limits<double>::infinity();
  judgement.held_out_before = comparison_.before_rms();
  judgement.held_out_after = comparison_.estimate_rms();
  const auto refuse = [&](std::string reason, std::string what_to_do) {
    judgement.reason = std::move(reason);
    judgement.manoeuvre = std::move(what_to_do);
    return judgement;
  };
  if (!current_seen_) return refuse("the motor card reports no current", "");
  const auto found = estimate();
  if (!found) return refuse("the motor's current has hardly changed while the field was read", manoeuvre);
  const Eigen::Vector3d eigenvalues = found->covariance.selfadjointView<Eigen::Lower>().eigenvalues();
  judgement.condition = eigenvalues[2] / eigenvalues[0];
  const double std = std::sqrt(found->covariance.diagonal().maxCoeff());
  const double limit = std::max(kAccurate_uT_per_A, kAccurate * found->slope_uT_per_A.norm());
  judgement.coverage = std::min(1.0, limit * limit / (std * std));
  if (std > limit) {
    return refuse("the field per ampere is uncertain by " + two_digits(std) + " uT/A", manoeuvre);
  }
  const double chi_square = found->slope_uT_per_A.dot(found->covariance.ldlt().solve(found->slope_uT_per_A));
  if (chi_square < kSeen) {
    return refuse("no field of the motor's current is seen beyond the error of " + two_digits(std) + " uT/A", "");
  }
  judgement.accepted = true;
  return judgement;
}

}  // namespace navcal::calib
