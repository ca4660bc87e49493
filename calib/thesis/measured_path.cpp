// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/thesis_paths.h"

#include <cmath>
#include <numbers>

#include "sim/path.h"

namespace navcal::calib::test {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

double wrapped(double angle_rad) { return angle_rad - kTurn_rad * std::floor(angle_rad / kTurn_rad); }

}  // namespace

std::vector<TruePoint> load_true_path(const std::string& name) {
  std::vector<TruePoint> path;
  for (const auto& row : sim::load_path(NAVCAL_SOURCE_DIR "/fixtures/paths/" + name + ".csv")) {
    TruePoint point;
    point.time_s = row.t_s;
    point.position_m = {row.position_m[0], row.position_m[1]};
    point.roll_rad = row.euler_rad[0];
    point.pitch_rad = row.euler_rad[1];
    // Unwrapped whatever the reader made of it.
    const double before = path.empty() ? row.euler_rad[2] : path.back().heading_rad;
    point.heading_rad = before + std::remainder(row.euler_rad[2] - before, kTurn_rad);
    point.velocity_body_m_s = {row.velocity_body_m_s[0], row.velocity_body_m_s[1], row.velocity_body_m_s[2]};
    point.rate_rad_s = {row.rate_rad_s[0], row.rate_rad_s[1], row.rate_rad_s[2]};
    path.push_back(point);
  }
  return path;
}

Deviation thesis_deviation() { return Deviation{0, 5, -5, 2, 2} * (std::numbers::pi / 180); }

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
    m.heading_rad =
        wrapped(measured_heading_rad(deviation, point.heading_rad) + noise.heading_rad * normal(random));
    m.roll_rad = point.roll_rad + noise.tilt_rad * normal(random);
    m.pitch_rad = point.pitch_rad + noise.tilt_rad * normal(random);
    m.rate_rad_s = point.rate_rad_s;
    m.rate_rad_s.z() = (point.rate_rad_s.z() - kTrueBias_rad_s) / kTrueScale;
    for (double& rate : m.rate_rad_s) rate += noise.rate_rad_s * normal(random);
    measured.push_back(m);
  }
  return measured;
}

}  // namespace navcal::calib::test
