// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "calib/readings.h"

namespace navcal::calib::test {

/// A hull that turns to both sides and rolls as it does, with its instruments: gyro at 20 Hz, compass at 10 Hz
/// whose field and heading are what was true `delay_s` before, levelled by an inclinometer of a lag.
struct DelayMotion {
  double delay_s = 0.012;
  double field_noise_uT = 0.15, rate_noise_rad_s = 0.0017, tilt_noise_rad = 0.0017, tilt_lag_s = 0.3;
  Eigen::Vector3d hard_iron_uT{2, -1.5, 3};
  Eigen::Vector3d rate_bias_rad_s{0.003, -0.004, 0.005};
  double turn = 1;  ///< 0: straight ahead

  static constexpr double kDip = 44.0 / 19.0;

  [[nodiscard]] double yaw(double t) const {
    return turn * (0.2 * t + 1.4 * std::sin(0.45 * t) + 0.5 * std::sin(1.1 * t));
  }
  [[nodiscard]] double roll(double t) const {
    return turn * 0.08 * std::sin(0.45 * t + 1) + 0.02 * std::sin(2 * t);
  }
  [[nodiscard]] double pitch(double t) const { return turn * 0.05 * std::sin(0.3 * t); }

  [[nodiscard]] Eigen::Matrix3d world_from_body(double t) const {
    return (Eigen::AngleAxisd(yaw(t), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(pitch(t), Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(roll(t), Eigen::Vector3d::UnitX()))
        .toRotationMatrix();
  }
  /// Through a first-order lag, by its series: lag is short against the motion.
  template <class Angle>
  [[nodiscard]] double lagged(Angle angle, double t) const {
    double sum = 0, weight = 0;
    for (double age_s = 0.005; age_s < 8 * tilt_lag_s; age_s += 0.01) {
      const double w = std::exp(-age_s / tilt_lag_s);
      sum += w * angle(t - age_s);
      weight += w;
    }
    return weight > 0 ? sum / weight : angle(t);
  }

  template <class Random>
  [[nodiscard]] RateReading rate(double t, Random& random) const {
    std::normal_distribution<double> normal;
    constexpr double kStep_s = 1e-3;
    const Eigen::AngleAxisd turned(
        Eigen::Matrix3d(world_from_body(t - kStep_s).transpose() * world_from_body(t + kStep_s)));
    RateReading reading;
    reading.time_s = t;
    reading.rate_rad_s = turned.axis() * turned.angle() / (2 * kStep_s) + rate_bias_rad_s;
    for (double& rate : reading.rate_rad_s) rate += rate_noise_rad_s * normal(random);
    return reading;
  }
  template <class Random>
  [[nodiscard]] CompassReading compass(double t, Random& random) const {
    std::normal_distribution<double> normal;
    const double then = t - delay_s;
    Eigen::Vector3d field = world_from_body(then).transpose() * Eigen::Vector3d(19, 0, 44) + hard_iron_uT;
    for (double& axis : field) axis += field_noise_uT * normal(random);
    const double phi = lagged([this](double s) { return roll(s); }, then) + tilt_noise_rad * normal(random);
    const double theta = lagged([this](double s) { return pitch(s); }, then) + tilt_noise_rad * normal(random);
    const double sf = std::sin(phi), cf = std::cos(phi), st = std::sin(theta), ct = std::cos(theta);
    CompassReading reading;
    reading.time_s = t;
    reading.field_body_uT = field;
    reading.roll_rad = phi;
    reading.pitch_rad = theta;
    reading.heading_rad =
        std::atan2(-(field.y() * cf - field.z() * sf), field.x() * ct + field.y() * sf * st + field.z() * cf * st);
    return reading;
  }
};

/// Feeds an estimator from `begin_s` to `end_s` in the order of times.
template <class Estimator, class Random>
void feed(Estimator& estimator, const DelayMotion& motion, double begin_s, double end_s, Random& random) {
  for (int k = static_cast<int>(begin_s * 20); k < end_s * 20; ++k) {
    const double t = k / 20.0;
    estimator.update(motion.rate(t, random));
    if (k % 2 == 0) estimator.update(motion.compass(t + 0.02, random));
  }
}

}  // namespace navcal::calib::test
