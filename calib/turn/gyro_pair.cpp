// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/gyro_pair.h"

#include <cmath>
#include <limits>

namespace navcal::calib {

void GyroPair::begin_window() {
  weight_ = square_weight_ = mean_rad_s_ = scatter_rad2_s2_ = 0;
  readings_ = 0;
}

void GyroPair::set_calibration(const Line& a, const Line& b) {
  if (a.scale == a_.scale && a.bias_rad_s == a_.bias_rad_s && b.scale == b_.scale &&
      b.bias_rad_s == b_.bias_rad_s) {
    return;
  }
  a_ = a;
  b_ = b;
  begin_window();
}

void GyroPair::update(const RateReading& reading) {
  if (!reading.yaw_rate_b_rad_s) return;
  const double difference =
      a_.scale * reading.rate_rad_s.z() + a_.bias_rad_s - (b_.scale * *reading.yaw_rate_b_rad_s + b_.bias_rad_s);
  if (!std::isfinite(difference) || !std::isfinite(reading.time_s) || reading.saturated) return;
  if (readings_ > 0) {
    const double since_s = reading.time_s - last_s_;
    if (std::abs(since_s) > parameters_.longest_gap_s) {
      begin_window();
    } else if (since_s <= 0) {
      return;
    } else {
      const double fading = std::exp(-since_s / parameters_.window_s);
      weight_ *= fading;
      square_weight_ *= fading * fading;
      scatter_rad2_s2_ *= fading;
    }
  }
  last_s_ = reading.time_s;
  ++readings_;
  weight_ += 1;
  square_weight_ += 1;
  const double from_mean = difference - mean_rad_s_;
  mean_rad_s_ += from_mean / weight_;
  scatter_rad2_s2_ += from_mean * (difference - mean_rad_s_);
}

std::optional<double> GyroPair::disagreement_rad_s() const {
  if (readings_ < kEnough) return std::nullopt;
  return mean_rad_s_;
}

double GyroPair::standard_error_rad_s() const {
  if (readings_ < kEnough) return std::numeric_limits<double>::infinity();
  // Kish's effective number of equally weighted readings.
  const double effective = weight_ * weight_ / square_weight_;
  return std::sqrt(scatter_rad2_s2_ / weight_ / (effective - 1));
}

void GyroPair::archive(Archive& archive) {
  archive.tag("gyro_pair 1");
  archive(a_.scale, a_.bias_rad_s, b_.scale, b_.bias_rad_s, last_s_, weight_, square_weight_, mean_rad_s_,
          scatter_rad2_s2_, readings_);
}

}  // namespace navcal::calib
