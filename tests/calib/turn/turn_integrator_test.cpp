// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace navcal::calib {
namespace {

double true_roll(double t) { return 0.15 * std::sin(1.3 * t); }
double true_pitch(double t) { return 0.1 * std::cos(0.9 * t); }
double turned_heading(double t) { return 0.8 * t + 0.5 * std::sin(0.7 * t); }

/// Body rates of the motion above, by its derivatives.
RateReading rate_at(double t) {
  const double p = 0.15 * 1.3 * std::cos(1.3 * t), q = -0.09 * std::sin(0.9 * t),
               r = 0.8 + 0.35 * std::cos(0.7 * t);
  RateReading reading;
  reading.time_s = t;
  reading.rate_rad_s = {p - r * std::sin(true_pitch(t)),
                        q * std::cos(true_roll(t)) + r * std::sin(true_roll(t)) * std::cos(true_pitch(t)),
                        -q * std::sin(true_roll(t)) + r * std::cos(true_roll(t)) * std::cos(true_pitch(t))};
  reading.yaw_rate_b_rad_s = 2 * reading.rate_rad_s.z();
  return reading;
}

CompassReading compass_at(double t) {
  CompassReading reading;
  reading.time_s = t;
  reading.heading_rad = std::remainder(turned_heading(t), 2 * M_PI);
  reading.roll_rad = true_roll(t);
  reading.pitch_rad = true_pitch(t);
  return reading;
}

struct Total {
  double turned = 0, turned_b = 0, bias_time = 0, first_s = -1, last_s = -1;
  int steps = 0, segments = 0;
  void take(TurnIntegrator& integrator) {
    while (const auto step = integrator.next()) {
      turned += step->measured_angle_rad + step->tilt_angle_rad;
      turned_b += step->measured_angle_b_rad / 2 + step->tilt_angle_rad;
      bias_time += step->bias_time_s;
      if (step->begins_segment) ++segments;
      if (first_s < 0) first_s = step->time_s;
      last_s = step->time_s;
      ++steps;
    }
  }
};

TEST(TurnIntegrator, OnACommonGridTheExactKinematics) {
  TurnIntegrator integrator({});
  Total total;
  for (int i = 0; i <= 300; ++i) {
    integrator.update(compass_at(0.1 * i));
    integrator.update(rate_at(0.1 * i));
    total.take(integrator);
  }
  EXPECT_EQ(total.steps, 300);
  EXPECT_EQ(total.segments, 1);
  EXPECT_NEAR(total.turned, turned_heading(total.last_s) - turned_heading(total.first_s), 3e-5);
  EXPECT_DOUBLE_EQ(total.turned, total.turned_b);
}

TEST(TurnIntegrator, AtTimesOfTheirOwnAndWithLatencyTheSame) {
  TurnIntegrator integrator({});
  Total total;
  // Gyro at 20 Hz, 25 ms late; compass at 10 Hz, 50 ms late.
  for (int ms = 0; ms < 30000; ++ms) {
    if (ms % 50 == 25) integrator.update(rate_at((ms - 25) / 1000.0));
    if (ms % 100 == 63) integrator.update(compass_at((ms - 50) / 1000.0));
    total.take(integrator);
  }
  EXPECT_GT(total.steps, 295);
  EXPECT_EQ(total.segments, 1);
  EXPECT_NEAR(total.turned, turned_heading(total.last_s) - turned_heading(total.first_s), 3e-5);
}

TEST(TurnIntegrator, TheOrderOfArrivalDoesNotMatter) {
  TurnIntegrator one({}), other({});
  Total first, second;
  for (int i = 0; i < 100; ++i) {
    one.update(compass_at(0.1 * i));
    one.update(rate_at(0.1 * i));
    first.take(one);
  }
  for (int i = 0; i < 100; ++i) other.update(rate_at(0.1 * i));
  for (int i = 0; i < 100; ++i) other.update(compass_at(0.1 * i));
  second.take(other);
  EXPECT_EQ(first.steps, second.steps);
  EXPECT_EQ(first.turned, second.turned);
}

TEST(TurnIntegrator, ASlowInclinometerIsHelpedByTheGyros) {
  constexpr double kLag_s = 0.3;
  double error[2];
  for (const bool helped : {false, true}) {
    TurnIntegrator::Parameters p;
    if (helped) p.tilt_lag_s = kLag_s;
    TurnIntegrator integrator(p);
    double lagged_roll = true_roll(0), lagged_pitch = true_pitch(0);
    double worst = 0, turned = 0, first = 0;
    for (int ms = 0; ms < 30000; ++ms) {
      const double t = ms / 1000.0;
      if (ms % 50 == 0) {
        RateReading rate = rate_at(t);
        rate.rate_rad_s.x() += 0.005;  // biases of a cold start
        rate.rate_rad_s.y() -= 0.005;
        integrator.update(rate);
      }
      if (ms % 100 == 0) {
        CompassReading compass = compass_at(t);
        compass.roll_rad = lagged_roll;
        compass.pitch_rad = lagged_pitch;
        integrator.update(compass);
      }
      lagged_roll += 0.001 / kLag_s * (true_roll(t) - lagged_roll);
      lagged_pitch += 0.001 / kLag_s * (true_pitch(t) - lagged_pitch);
      while (const auto step = integrator.next()) {
        if (step->begins_segment) first = step->time_s;
        turned += step->measured_angle_rad + step->tilt_angle_rad;
        worst = std::max(worst, std::abs(turned - (turned_heading(step->time_s) - turned_heading(first))));
      }
    }
    error[helped] = worst;
  }
  EXPECT_LT(error[1], 0.5 * error[0]);
}

TEST(TurnIntegrator, GapsBeginSegments) {
  TurnIntegrator integrator({});
  Total total;
  for (int i = 0; i < 300; ++i) {
    if (i < 100 || i >= 110) integrator.update(compass_at(0.1 * i));
    if (i < 200 || i >= 210) integrator.update(rate_at(0.1 * i));
    total.take(integrator);
  }
  EXPECT_EQ(total.segments, 3);
}

TEST(TurnIntegrator, BadReadingsAreLeftOut) {
  TurnIntegrator integrator({});
  Total total;
  for (int i = 0; i <= 300; ++i) {
    CompassReading compass = compass_at(0.1 * i);
    RateReading rate = rate_at(0.1 * i);
    integrator.update(compass);
    integrator.update(rate);
    integrator.update(compass);  // repeated
    integrator.update(rate);
    rate.time_s -= 0.05;  // reversed
    integrator.update(rate);
    rate.time_s += 0.06;
    rate.rate_rad_s.z() = std::numeric_limits<double>::quiet_NaN();
    integrator.update(rate);
    compass.time_s += 0.05;
    compass.faulty = true;
    integrator.update(compass);
    compass.faulty = false;
    compass.heading_rad.reset();
    integrator.update(compass);
    compass = compass_at(0.1 * i + 0.05);
    compass.pitch_rad = 1.5;
    integrator.update(compass);
    total.take(integrator);
  }
  EXPECT_EQ(integrator.left_out(), 7U * 301);
  EXPECT_EQ(total.steps, 300);
  EXPECT_NEAR(total.turned, turned_heading(total.last_s) - turned_heading(total.first_s), 3e-5);
}

TEST(TurnIntegrator, RestoredGoesOnBitForBit) {
  TurnIntegrator integrator({}), restored({});
  Total before;
  for (int i = 0; i < 50; ++i) {
    integrator.update(compass_at(0.1 * i));
    integrator.update(rate_at(0.1 * i));
    before.take(integrator);
  }
  Archive saving;
  saving(integrator);
  Archive restoring{std::string_view(saving.bytes())};
  restoring(restored);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  Total one, other;
  for (int i = 50; i < 100; ++i) {
    for (TurnIntegrator* each : {&integrator, &restored}) {
      each->update(compass_at(0.1 * i));
      each->update(rate_at(0.1 * i));
    }
    one.take(integrator);
    other.take(restored);
  }
  EXPECT_EQ(one.steps, 50);
  EXPECT_EQ(one.turned, other.turned);
  EXPECT_EQ(one.steps, other.steps);
}

}  // namespace
}  // namespace navcal::calib
