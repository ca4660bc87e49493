// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/symmetric_eigen.h"
#include "calib/coverage.h"
#include "calib/gps/gps_compass.h"

namespace navcal::calib {

Judgement GpsCompass::judgement() const {
  Judgement judgement;
  judgement.samples = summary_.fixes();
  judgement.coverage = static_cast<double>(visited(rose_)) / static_cast<double>(rose_.size());
  judgement.condition = std::numeric_limits<double>::infinity();
  if (!estimate_) {
    return judgement.refused("too few fixes at the surface, under way",
                             "drive at the surface through all headings, turning to both sides, for some minutes");
  }
  // The condition number refers to the covariance scaled to unit diagonal. It tells how well the unknowns are
  // separated.
  const Vector std = estimate_->covariance.diagonal().cwiseSqrt();
  const Matrix correlation =
      std.cwiseInverse().asDiagonal() * estimate_->covariance * std.cwiseInverse().asDiagonal();
  const Vector eigenvalues = base::symmetric_eigenvalues(correlation);
  if (eigenvalues[0] > 0) judgement.condition = eigenvalues[kUnknowns - 1] / eigenvalues[0];
  judgement.accepted = estimate_->converged && estimate_->worst_std_rad <= parameters_.accepted_std_rad;
  if (judgement.accepted) return judgement;
  const double least = estimate_->worst_std_rad * 180 / std::numbers::pi;
  judgement.reason = !estimate_->converged
                         ? "the fixes fit no deviation of this kind"
                         : "the heading would be uncertain by " + std::to_string(std::lround(std::ceil(least))) +
                               " degrees or so at " +
                               std::to_string(std::lround(estimate_->worst_heading_rad * 180 / std::numbers::pi));
  judgement.manoeuvre = missing_turn(rose_);
  if (judgement.manoeuvre.empty())
    judgement.manoeuvre = "go on at the surface through all headings, turning to both sides";
  return judgement;
}

}  // namespace navcal::calib
