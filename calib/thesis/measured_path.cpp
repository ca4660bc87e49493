// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/measured_path.h"

#include <cmath>

#include "base/angles.h"

namespace navcal::calib::thesis {

Deviation thesis_deviation() { return Deviation{0, 5, -5, 2, 2} * base::kRadiansPerDegree; }

Eigen::Vector4d harmonics(double heading_rad) {
  return {std::sin(heading_rad), std::cos(heading_rad), std::sin(2 * heading_rad), std::cos(2 * heading_rad)};
}

double deviation_rad(const Deviation& c, double psi) {
  return c[0] + c[1] * std::sin(psi) + c[2] * std::cos(psi) + c[3] * std::sin(2 * psi) + c[4] * std::cos(2 * psi);
}

double measured_heading_rad(const Deviation& coefficients, double true_heading_rad) {
  // A contraction, as |E'| < 1 for any deviation that a compass can have.
  double measured = true_heading_rad;
  for (int i = 0; i < 60; ++i) measured = true_heading_rad + deviation_rad(coefficients, measured);
  return measured;
}

CompassReading compass_of(const Measured& measured) {
  CompassReading compass;
  compass.time_s = measured.time_s;
  compass.heading_rad = measured.heading_rad;
  compass.roll_rad = measured.roll_rad;
  compass.pitch_rad = measured.pitch_rad;
  return compass;
}

RateReading rate_of(const Measured& measured) {
  RateReading rate;
  rate.time_s = measured.time_s;
  rate.rate_rad_s = measured.rate_rad_s;
  return rate;
}

std::vector<Measured> measure(const std::vector<TruePoint>& path, const Deviation& deviation, const Noise& noise,
                              Random& random) {
  std::normal_distribution<double> normal;
  std::vector<Measured> measured;
  measured.reserve(path.size());
  for (const TruePoint& point : path) {
    Measured m;
    m.time_s = point.time_s;
    m.heading_rad = base::positive_angle(measured_heading_rad(deviation, point.heading_rad) +
                                         noise.heading_rad * normal(random));
    m.roll_rad = point.roll_rad + noise.tilt_rad * normal(random);
    m.pitch_rad = point.pitch_rad + noise.tilt_rad * normal(random);
    m.rate_rad_s = point.rate_rad_s;
    m.rate_rad_s.z() = (point.rate_rad_s.z() - kTrueBias_rad_s) / kTrueScale;
    for (double& rate : m.rate_rad_s) rate += noise.rate_rad_s * normal(random);
    measured.push_back(m);
  }
  return measured;
}

}  // namespace navcal::calib::thesis
