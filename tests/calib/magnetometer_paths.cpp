// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/magnetometer_paths.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/turn/turn_integrator.h"

namespace navcal::calib::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

EllipseShape flattened_circle(double forward_uT, double starboard_uT, double eccentricity, double axis_deg) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(axis_deg * kDegree).toRotationMatrix();
  EllipseShape shape;
  shape.centre_uT = {forward_uT, starboard_uT};
  shape.axes_uT =
      20 * turn * Eigen::Vector2d(1, std::sqrt(1 - eccentricity * eccentricity)).asDiagonal() * turn.transpose();
  return shape;
}

}  // namespace

EllipseShape figure_4_11() { return flattened_circle(2, 2, 0.5, 120); }
EllipseShape figure_4_12() { return flattened_circle(2, -4, 0.8, 10); }

std::vector<FieldReading> level_field_on(const std::vector<TruePoint>& path, const EllipseShape& shape,
                                         const Noise& noise, Random& random) {
  const std::vector<Measured> measured = measure(path, Deviation::Zero(), noise, random);
  std::normal_distribution<double> normal;
  TurnIntegrator integrator({});
  std::vector<FieldReading> readings;
  readings.reserve(path.size());
  const auto take = [&] {
    while (const auto step = integrator.next()) {
      FieldReading reading;
      const Eigen::Vector2d field = shape.at(path[readings.size()].heading_rad) +
                                    noise.field_uT * Eigen::Vector2d(normal(random), normal(random));
      reading.field_body_uT.head<2>() = field;
      reading.turn = *step;
      readings.push_back(reading);
    }
  };
  for (const Measured& m : measured) {
    RateReading rate = rate_of(m);
    rate.yaw_rate_b_rad_s = m.rate_rad_s.z();
    integrator.update(compass_of(m));
    integrator.update(rate);
    take();
  }
  integrator.begin_segment();
  take();
  return readings;
}

HeadingError heading_error(const FieldCorrection& found, const EllipseShape& truth) {
  constexpr int kHeadings = 360;
  HeadingError error;
  for (int i = 0; i < kHeadings; ++i) {
    const double heading = i * kDegree;
    Eigen::Vector3d field = Eigen::Vector3d::Zero();
    field.head<2>() = truth.at(heading);
    const double off =
        std::remainder(levelled_heading(found(field), 0, 0) - heading, 2 * std::numbers::pi) / kDegree;
    error.largest_deg = std::max(error.largest_deg, std::abs(off));
    error.rms_deg += off * off / kHeadings;
  }
  error.rms_deg = std::sqrt(error.rms_deg);
  return error;
}

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
