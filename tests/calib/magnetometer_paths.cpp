// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/magnetometer_paths.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace navcal::calib::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

KnownField reference_field() {
  const double across = std::hypot(19.0, 0.6);
  KnownField known;
  known.magnitude_uT = std::hypot(across, 44.0);
  known.dip_rad = std::atan2(44.0, across);
  return known;
}

Eigen::Vector3d field_in_body(const Attitude& a) {
  const Eigen::Vector3d field(std::hypot(19.0, 0.6), 0, 44.0);
  return Eigen::AngleAxisd(-a.roll_rad, Eigen::Vector3d::UnitX()) *
         (Eigen::AngleAxisd(-a.pitch_rad, Eigen::Vector3d::UnitY()) *
          (Eigen::AngleAxisd(-a.heading_rad, Eigen::Vector3d::UnitZ()) * field));
}

Iron some_iron() {
  Iron iron;
  iron.hard_uT = {4, -6, 9};
  iron.soft << 1.04, 0.02, 0, 0.02, 0.97, 0.01, 0, 0.01, 1.02;
  return iron;
}

std::vector<Attitude> swinging(int readings, double turn_deg, double roll_deg, double pitch_deg) {
  std::vector<Attitude> motion;
  for (int i = 0; i < readings; ++i) {
    const double way = 2.0 * i / readings;
    const double there = way < 1 ? way : 2 - way;
    motion.push_back({turn_deg * there * kDegree, roll_deg * std::sin(0.11 * i) * kDegree,
                      pitch_deg * std::sin(0.037 * i) * kDegree});
  }
  return motion;
}

std::vector<FieldReading> field_on(const std::vector<Attitude>& motion, const Iron& iron, Random& random) {
  constexpr double kFieldNoise_uT = 0.15;
  constexpr double kTiltNoise_rad = 0.1 * kDegree;
  std::normal_distribution<double> normal;
  std::vector<FieldReading> readings;
  readings.reserve(motion.size());
  for (const Attitude& attitude : motion) {
    FieldReading reading;
    reading.field_body_uT = iron.soft * field_in_body(attitude) + iron.hard_uT;
    for (double& component : reading.field_body_uT) component += kFieldNoise_uT * normal(random);
    reading.roll_rad = attitude.roll_rad + kTiltNoise_rad * normal(random);
    reading.pitch_rad = attitude.pitch_rad + kTiltNoise_rad * normal(random);
    readings.push_back(reading);
  }
  return readings;
}

}  // namespace navcal::calib::test
