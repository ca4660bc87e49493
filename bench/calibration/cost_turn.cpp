// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>

#include "bench/calibration/cost.h"
#include "calib/turn/gyro_pair.h"
#include "calib/turn/turn_filter.h"
#include "calib/turn/turn_integrator.h"

namespace navcal::bench {

using namespace calib;

namespace {

/// Turns both ways, at 10 Hz.
TurnStep turn_step(std::size_t sample) {
  const double t = 0.1 * static_cast<double>(sample);
  const double rate = 0.5 * std::sin(0.1 * t);
  TurnStep step;
  step.time_s = t;
  step.begins_segment = sample == 0;
  step.duration_s = step.bias_time_s = 0.1;
  step.measured_angle_rad = step.measured_angle_b_rad = 0.1 * rate;
  step.heading_rad = std::remainder(5 * (1 - std::cos(0.1 * t)), 6.283185307179586);
  return step;
}

std::function<void(std::size_t)> filter(const TurnPrior& prior) {
  auto state = std::make_shared<TurnFilter>(TurnFilter::Parameters{}, prior);
  return [state](std::size_t sample) { state->update(turn_step(sample)); };
}

}  // namespace

std::vector<CostItem> turn_costs() {
  return {{"TurnFilter, gyro", [] { return filter(TurnPrior::unknown_gyro()); }},
          {"TurnFilter, gyro and compass", [] { return filter(TurnPrior::unknown_both()); }},
          {"TurnIntegrator, compass reading with two of the gyro",
           [] {
             auto state = std::make_shared<TurnIntegrator>(TurnIntegrator::Parameters{});
             return std::function<void(std::size_t)>([state](std::size_t sample) {
               CompassReading compass;
               compass.time_s = 0.1 * static_cast<double>(sample);
               compass.heading_rad = compass.roll_rad = compass.pitch_rad = 0.1;
               RateReading rate;
               rate.time_s = compass.time_s + 0.02;
               state->update(rate);
               rate.time_s += 0.05;
               state->update(rate);
               state->update(compass);
               while (state->next()) {
               }
             });
           }},
          {"GyroPair", [] {
             auto state = std::make_shared<GyroPair>(GyroPair::Parameters{});
             return std::function<void(std::size_t)>([state](std::size_t sample) {
               RateReading rate;
               rate.time_s = 0.05 * static_cast<double>(sample);
               rate.yaw_rate_b_rad_s = rate.rate_rad_s.z() = std::sin(rate.time_s);
               state->update(rate);
             });
           }}};
}

}  // namespace navcal::bench
