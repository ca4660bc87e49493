// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_prior.h"

namespace navcal::calib {
namespace {

/// Far beyond any scale, bias (rad/s) or deviation (rad), and still no limit to the accuracy of doubles.
constexpr double kUnknownStd = 10;

}  // namespace

TurnPrior TurnPrior::unknown_gyro() {
  TurnPrior prior;
  for (int i : {kScale, kBias}) {
    prior.covariance(i, i) = kUnknownStd * kUnknownStd;
    prior.sought[static_cast<std::size_t>(i)] = true;
  }
  return prior;
}

TurnPrior TurnPrior::unknown_compass(double scale, double bias_rad_s, const Eigen::Matrix2d& gyro_covariance) {
  TurnPrior prior = unknown_both();
  prior.mean[kScale] = scale;
  prior.mean[kBias] = bias_rad_s;
  prior.covariance.topLeftCorner<2, 2>() = gyro_covariance;
  prior.sought[kScale] = prior.sought[kBias] = false;
  return prior;
}

TurnPrior TurnPrior::unknown_both() {
  TurnPrior prior;
  prior.covariance.diagonal().setConstant(kUnknownStd * kUnknownStd);
  prior.sought.fill(true);
  return prior;
}

}  // namespace navcal::calib
