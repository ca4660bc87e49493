// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_calibrator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "calib/coverage.h"

namespace navcal::calib {
namespace {

/// Fewer sectors than this, and the vehicle has only yawed about a heading.
constexpr std::size_t kNoTurn = 4;

void refuse(Judgement& judgement, std::string reason, std::string manoeuvre) {
  judgement.reason = std::move(reason);
  judgement.manoeuvre = std::move(manoeuvre);
}

}  // namespace

TurnCalibrator::TurnCalibrator(Subject subject, const TurnFilter::Parameters& parameters)
    : subject_(subject), parameters_(parameters), filter_(parameters) {}

void TurnCalibrator::update(const TurnStep& step) {
  filter_.update(step);
  if (std::isfinite(step.heading_rad)) ++rose_[sector_of(step.heading_rad)];
}

void TurnCalibrator::start(const TurnPrior& prior) {
  filter_ = TurnFilterBank(parameters_, prior);
  gyro_known_ = !prior.sought[kScale];
  rose_ = {};
}

double TurnCalibrator::worst_heading_std_rad() const {
  const Eigen::Matrix4d covariance = filter_.covariance().bottomRightCorner<4, 4>();
  double worst = 0;
  constexpr int kHeadings = 72;
  for (int i = 0; i < kHeadings; ++i) {
    const double psi = 2 * std::numbers::pi * i / kHeadings;
    const Eigen::Vector4d f(std::sin(psi), std::cos(psi), std::sin(2 * psi), std::cos(2 * psi));
    worst = std::max(worst, f.dot(covariance * f));
  }
  return std::sqrt(worst);
}

Judgement TurnCalibrator::judgement() const {
  Judgement judgement;
  judgement.samples = filter_.readings();
  judgement.coverage = static_cast<double>(visited(rose_)) / static_cast<double>(rose_.size());
  judgement.condition = filter_.condition();
  if (filter_.readings() < limits_.readings) {
    refuse(judgement, "fewer than 50 readings of compass and gyro together", "keep both instruments running");
  } else if (visited(rose_) < kNoTurn) {
    refuse(judgement, "the vehicle has not turned", "make full turns, both ways and at different rates");
  } else if (!gyro_known_ && visited(rose_) < limits_.sectors) {
    refuse(judgement,
           "only " + rounded(judgement.coverage * 360, 0) +
               " degrees of the circle were seen: the gyro's scale cannot be told from the compass's deviation",
           missing_turn(rose_));
  } else if (filter_.reduced_chi_squared() > limits_.chi_squared) {
    refuse(
        judgement,
        "the readings scatter " + rounded(std::sqrt(filter_.reduced_chi_squared()), 1) +
            " times as much as configured: the compass is disturbed, or its deviation is not of the form A to E",
        "turn away from steel and currents; the magnetometer's calibration corrects what A to E cannot");
  } else if (subject_ == Subject::gyro) {
    judge_gyro(judgement);
  } else {
    judge_compass(judgement);
  }
  judgement.accepted = judgement.reason.empty();
  return judgement;
}

void TurnCalibrator::judge_gyro(Judgement& judgement) const {
  const TurnCovariance covariance = filter_.covariance();
  const double scale_std = std::sqrt(covariance(kScale, kScale));
  const double bias_std = std::sqrt(covariance(kBias, kBias));
  // Written so that not-a-number is refused too.
  if (!(scale_std <= limits_.scale_std)) {
    refuse(judgement, "the scale is known to " + rounded(scale_std * 100, 1) + " % only: the rate hardly changed",
           "turn the other way, or at another rate, too");
  } else if (!(bias_std <= limits_.bias_std_rad_s)) {
    refuse(judgement, "the bias is known to " + rounded(bias_std * base::kDegreesPerRadian, 2) + " deg/s only",
           "go on for longer, straight and turning");
  }
}

void TurnCalibrator::judge_compass(Judgement& judgement) const {
  const double heading_std = worst_heading_std_rad();
  if (heading_std <= limits_.heading_std_rad) return;
  const std::string missing = missing_turn(rose_);
  refuse(judgement,
         "the corrected heading would be known to " + rounded(heading_std * base::kDegreesPerRadian, 1) +
             " degrees only",
         missing.empty() ? "turn slowly through the circle once more" : missing);
}

void TurnCalibrator::archive(Archive& archive) {
  archive.tag("turn_calibrator 2");
  archive(filter_, gyro_known_, rose_);
}

}  // namespace navcal::calib
