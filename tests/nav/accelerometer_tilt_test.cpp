// SPDX-License-Identifier: Apache-2.0
// Roll and pitch by accelerometers: at rest, in turns, while the speed changes, with bad readings.
#include "nav/accelerometer_tilt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace navcal::nav {
namespace {

constexpr double kDegree = 0.017453292519943295, kGravity = 9.81;
constexpr std::int64_t kStep_ns = 50'000'000;

struct Truth {
  double roll_rad = 0, pitch_rad = 0;
  double speed_m_s = 0, acceleration_m_s2 = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
};

Eigen::Vector3d specific_force(const Truth& truth) {
  const Eigen::Vector3d gravity =
      kGravity * Eigen::Vector3d(-std::sin(truth.pitch_rad), std::cos(truth.pitch_rad) * std::sin(truth.roll_rad),
                                 std::cos(truth.pitch_rad) * std::cos(truth.roll_rad));
  const Eigen::Vector3d ahead(truth.speed_m_s, 0, 0);
  return Eigen::Vector3d(truth.acceleration_m_s2, 0, 0) + truth.rate_rad_s.cross(ahead) - gravity;
}

/// Rms error of roll and pitch from `from_s` on, degrees; the shaft is told when `with_shaft`.
double rms_deg(const std::function<Truth(double t_s)>& truth_at, double from_s, double to_s, bool with_shaft,
               double noise_m_s2 = 0.02, double bias_rad_s = 0) {
  AccelerometerTilt tilt({});
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, noise_m_s2), rate_noise(0, 0.1 * kDegree);
  double sum = 0, count = 0;
  for (std::int64_t t_ns = 0; static_cast<double>(t_ns) * 1e-9 < to_s; t_ns += kStep_ns) {
    const double t_s = static_cast<double>(t_ns) * 1e-9;
    const Truth truth = truth_at(t_s);
    RateReading reading;
    reading.time_ns = t_ns;
    reading.rate_rad_s = truth.rate_rad_s +
                         Eigen::Vector3d(rate_noise(random) + bias_rad_s, rate_noise(random), rate_noise(random));
    reading.specific_force_m_s2 =
        specific_force(truth) + Eigen::Vector3d(noise(random), noise(random), noise(random));
    if (with_shaft) tilt.take(ShaftReading{t_ns, truth.speed_m_s / 0.0872});
    tilt.take(reading);
    if (t_s < from_s) continue;
    const auto found = tilt.newest();
    sum += std::pow(found->roll_rad - truth.roll_rad, 2) + std::pow(found->pitch_rad - truth.pitch_rad, 2);
    count += 2;
  }
  return std::sqrt(sum / count) / kDegree;
}

TEST(AccelerometerTilt, AtRestATenthOfADegree) {
  const auto rest = [](double) { return Truth{.roll_rad = 8 * kDegree, .pitch_rad = -5 * kDegree}; };
  EXPECT_LT(rms_deg(rest, 5, 60, false), 0.1);
  EXPECT_LT(rms_deg(rest, 60, 300, false, 0.02, 0.5 * kDegree), 0.1) << "the gyro's bias is learnt";
}

TEST(AccelerometerTilt, InATurnTheSpeedOfTheShaftTakesTheCentripetalForceOut) {
  const auto turn = [](double) { return Truth{.speed_m_s = 1.3, .rate_rad_s = Eigen::Vector3d(0, 0, 0.3)}; };
  EXPECT_LT(rms_deg(turn, 10, 60, true), 0.15);
  EXPECT_GT(rms_deg(turn, 10, 60, false), 1.0) << "without a speed the turn shows as roll";
}

TEST(AccelerometerTilt, ASpeedOverGroundServesWhereNoShaftIs) {
  AccelerometerTilt tilt({});
  const Truth truth{.speed_m_s = 1.3, .rate_rad_s = Eigen::Vector3d(0, 0, 0.3)};
  for (int i = 0; i < 1200; ++i) {
    RateReading reading{i * kStep_ns, truth.rate_rad_s, std::nullopt, specific_force(truth)};
    if (i % 20 == 0) {
      FixReading fix;
      fix.time_ns = i * kStep_ns;
      fix.velocity_m_s = Eigen::Vector2d(1.3 * std::cos(0.015 * i), 1.3 * std::sin(0.015 * i));
      tilt.take(fix);
    }
    tilt.take(reading);
  }
  EXPECT_NEAR(tilt.newest()->roll_rad, 0, 0.1 * kDegree);
}

TEST(AccelerometerTilt, ASpeedThatChangesIsNoPitch) {
  // From rest to 1.3 m/s, through the lag of the vehicle's speed behind the shaft's.
  AccelerometerTilt tilt({});
  double speed_m_s = 0, most_rad = 0;
  for (int i = 0; i < 400; ++i) {
    const double shaft_m_s = i > 100 ? 1.3 : 0;
    const double before_m_s = speed_m_s;
    speed_m_s += (shaft_m_s - speed_m_s) * -std::expm1(-0.05 / 0.9);
    Truth truth;
    truth.speed_m_s = speed_m_s;
    truth.acceleration_m_s2 = (speed_m_s - before_m_s) / 0.05;
    tilt.take(ShaftReading{i * kStep_ns, shaft_m_s / 0.0872});
    tilt.take(RateReading{i * kStep_ns, Eigen::Vector3d::Zero(), std::nullopt, specific_force(truth)});
    most_rad = std::max(most_rad, std::abs(tilt.newest()->pitch_rad));
  }
  EXPECT_LT(most_rad, 0.3 * kDegree);
}

TEST(AccelerometerTilt, IsAskedForTheTimeOfAReading) {
  AccelerometerTilt tilt({});
  EXPECT_FALSE(tilt.newest());
  EXPECT_FALSE(tilt.at(0));
  Truth truth{.pitch_rad = 0.1};
  for (int i = 0; i < 100; ++i) {
    tilt.take(RateReading{i * kStep_ns, Eigen::Vector3d::Zero(), std::nullopt, specific_force(truth)});
  }
  EXPECT_NEAR(tilt.at(97 * kStep_ns + 20'000'000)->pitch_rad, 0.1, 1e-6);
  EXPECT_NEAR(tilt.at(100 * kStep_ns)->pitch_rad, 0.1, 1e-6);
  EXPECT_FALSE(tilt.at(120 * kStep_ns)) << "a second later it may be anything";
}

TEST(AccelerometerTilt, BadReadingsSpoilNothing) {
  AccelerometerTilt tilt({});
  const Truth truth{.roll_rad = 0.05};
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d force = specific_force(truth);
    tilt.take(RateReading{i * kStep_ns, Eigen::Vector3d::Zero(), std::nullopt, force});
    tilt.take(RateReading{i * kStep_ns + 1, Eigen::Vector3d(kNan, 0, 0), std::nullopt, force});
    tilt.take(RateReading{i * kStep_ns + 2, Eigen::Vector3d::Zero(), std::nullopt, Eigen::Vector3d(0, kNan, 0)});
    tilt.take(RateReading{i * kStep_ns + 3, Eigen::Vector3d::Zero(), std::nullopt, 5 * force});
    tilt.take(RateReading{i * kStep_ns - 7, Eigen::Vector3d(1, 1, 1), std::nullopt, force});
    tilt.take(RateReading{i * kStep_ns + 4, Eigen::Vector3d(1, 1, 1), std::nullopt, std::nullopt});
  }
  EXPECT_NEAR(tilt.newest()->roll_rad, 0.05, 0.02 * kDegree);
  EXPECT_NEAR(tilt.newest()->pitch_rad, 0, 0.02 * kDegree);
}

/// Tilt errors of a level, spinning and swinging vehicle with the accelerometers at `place_m`, told or not,
/// degrees.
double error_at_place_deg(const Eigen::Vector3d& place_m, bool is_told) {
  AccelerometerTilt tilt({});
  double sum = 0;
  int count = 0;
  for (std::int64_t t_ns = 0; t_ns < 60'000'000'000; t_ns += kStep_ns) {
    const double t_s = static_cast<double>(t_ns) * 1e-9;
    // A level vehicle whose rate of turn swings about 0.8 rad/s.
    const Eigen::Vector3d rate(0, 0, 0.8 + 0.3 * std::sin(2 * t_s)), change(0, 0, 0.6 * std::cos(2 * t_s));
    RateReading reading;
    reading.time_ns = t_ns;
    reading.rate_rad_s = rate;
    reading.specific_force_m_s2 =
        Eigen::Vector3d(0, 0, -kGravity) + rate.cross(rate.cross(place_m)) + change.cross(place_m);
    if (is_told) reading.force_position_m = place_m;
    tilt.take(reading);
    if (t_s < 10) continue;
    const auto found = tilt.newest();
    sum += std::pow(found->roll_rad, 2) + std::pow(found->pitch_rad, 2);
    ++count;
  }
  return std::sqrt(sum / count) / kDegree;
}

TEST(AccelerometerTilt, AccelerometersAwayFromTheOriginFeelTheTurn) {
  const Eigen::Vector3d place_m(0.8, -0.3, 0.2);
  EXPECT_GT(error_at_place_deg(place_m, false), 2) << "0.55 m/s2 in 9.81";
  EXPECT_LT(error_at_place_deg(place_m, true), 0.1);
  EXPECT_LT(error_at_place_deg(Eigen::Vector3d::Zero(), false), 1e-6);
}

}  // namespace
}  // namespace navcal::nav
