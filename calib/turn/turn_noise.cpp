// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_noise.h"

namespace navcal::calib {

void TurnNoise::start(const Row& direction, double variance) {
  heading_ = variance * direction * direction.transpose();
  heading_bias_.setZero();
}

void TurnNoise::predict(double bias_time_s, const Row& direction, double variance) {
  heading_ += bias_time_s * (heading_bias_ + heading_bias_.transpose()) + bias_time_s * bias_time_s * bias_ +
              variance * direction * direction.transpose();
  heading_bias_ += bias_time_s * bias_;
}

void TurnNoise::correct(const Row& direction, double variance, double innovation_variance,
                        const Eigen::Vector2d& gain) {
  const Products of_reading = variance * direction * direction.transpose();
  const Products of_row = heading_ + of_reading;
  expected_ += of_row / innovation_variance;
  // The rows of heading and bias each lose gain times the innovation's row.
  const Products mixed = heading_bias_ + heading_bias_.transpose();
  bias_ += gain[1] * gain[1] * of_row - gain[1] * mixed;
  heading_bias_ = (1 - gain[0]) * (heading_bias_ - gain[1] * heading_) + gain[0] * gain[1] * of_reading;
  heading_ = (1 - gain[0]) * (1 - gain[0]) * heading_ + gain[0] * gain[0] * of_reading;
}

}  // namespace navcal::calib
