// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "bench/calibration/cost.h"
#include "calib/correction.h"
#include "calib/suite/suite.h"

namespace navcal::bench {

using namespace calib;

namespace {

/// The instruments of a vehicle that turns for a minute and goes straight for one, at the rates of the reference
/// vehicle: 20 Hz inertial card, 10 Hz compass and motor card, 1 Hz GPS.
class Vehicle {
 public:
  /// Processes one step of the inertial card.
  void step(Suite& suite) {
    const double t = 0.05 * static_cast<double>(steps_);
    const double rate = std::fmod(t, 120) > 60 ? 0 : 0.3 + 0.25 * std::sin(0.2 * t);
    heading_rad_ = std::remainder(heading_rad_ + 0.05 * rate, 2 * std::numbers::pi);
    position_m_ += 0.055 * Eigen::Vector2d(std::cos(heading_rad_), std::sin(heading_rad_));
    RateReading gyro;
    gyro.time_s = t;
    gyro.rate_rad_s = {noise(0.0017), noise(0.0017), (rate - 0.01) / 1.05 + noise(0.0017)};
    gyro.yaw_rate_b_rad_s = rate + noise(0.0017);
    suite.put(gyro);
    if (steps_ % 2 == 0) {
      suite.put(compass(t + 0.003));
      suite.put(MotorReading{t + 0.004, 780 + noise(1)});
    }
    if (steps_ % 20 == 0) {
      GroundReading ground;
      ground.time_s = t + 0.005;
      ground.position_m = position_m_ + Eigen::Vector2d(noise(1), noise(1));
      ground.speed_m_s = 1.1 + noise(0.1);
      ground.course_rad = heading_rad_ + noise(0.1);
      suite.put(ground);
    }
    ++steps_;
  }

 private:
  double noise(double std) { return std * normal_(random_); }

  CompassReading compass(double time_s) {
    const double roll = 0.05 * std::sin(time_s), pitch = 0.05 * std::cos(0.7 * time_s);
    const Eigen::Matrix3d body_from_world =
        (Eigen::AngleAxisd(heading_rad_, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
            .toRotationMatrix()
            .transpose();
    Eigen::Vector3d field_uT = body_from_world * Eigen::Vector3d(19, 0.6, 44) + Eigen::Vector3d(3, -2, 4);
    for (double& axis : field_uT) axis += noise(0.15);
    CompassReading reading;
    reading.time_s = time_s;
    reading.roll_rad = roll + noise(0.0017);
    reading.pitch_rad = pitch + noise(0.0017);
    reading.field_body_uT = field_uT;
    reading.heading_rad = levelled_heading(field_uT, *reading.roll_rad, *reading.pitch_rad);
    return reading;
  }

  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
  std::size_t steps_ = 0;
  double heading_rad_ = 0;
  Eigen::Vector2d position_m_ = Eigen::Vector2d::Zero();
};

}  // namespace

std::vector<CostItem> suite_costs() {
  return {{"all calibrators together, 1/20 s of the vehicle (a core has 5 10^7 ns)",
           [] {
             SuiteOptions options;
             options.local_field.known = KnownField{48, 1.16, 0.5, 0.01};
             auto suite = std::make_shared<Suite>(options, Instruments{true, true, true, true});
             auto vehicle = std::make_shared<Vehicle>();
             return std::function<void(std::size_t)>([=](std::size_t) { vehicle->step(*suite); });
           },
           100'000}};
}

}  // namespace navcal::bench
