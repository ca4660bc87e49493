// SPDX-License-Identifier: Apache-2.0
// Estimates of charge and altitude against the truth of simulated missions; docs/battery.md and docs/navigation.md
// quote what these tests print.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "config/mission_file.h"
#include "nav/altitude_filter.h"
#include "pipeline/battery_estimator.h"
#include "sim/instruments/altimeter.h"
#include "sim/instruments/battery_gauge.h"
#include "sim/noise.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal {
namespace {

constexpr int kMissions = 50;
constexpr double kDuration_s = 900;

/// A quarter of an hour of the survey, the same for every mission: what differs are instruments, batteries and
/// floors.
const sim::Motion& survey() {
  static const config::VehicleSettings vehicle;
  static const sim::SimulatedMotion motion(
      vehicle, std::make_unique<sim::MissionHelm>(vehicle, config::load_mission("survey")), {});
  return motion;
}

std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

/// Errors, and how many of them lie within two stated standard deviations.
struct Score {
  int all = 0, within = 0;
  double squares = 0, stated_squares = 0;

  void add(double error, double std) {
    ++all;
    within += std::abs(error) <= 2 * std ? 1 : 0;
    squares += error * error;
    stated_squares += std * std;
  }
  [[nodiscard]] double share() const { return static_cast<double>(within) / all; }
  void print(const char* what, const char* unit) const {
    std::cout << what << ": rms error " << std::sqrt(squares / all) << ' ' << unit << ", stated "
              << std::sqrt(stated_squares / all) << ' ' << unit << ", " << 100 * share()
              << " % within two standard deviations of " << all << '\n';
  }
};

struct Discharge {
  sim::Battery battery;
  double current_scale, hotel_A, curve_error_V;
};

/// True errors as large as the estimator is told.
Discharge draw(sim::Noise& noise, const config::BatterySettings& options, double charge_Ah) {
  sim::Battery::Options truth;
  truth.charge_Ah = charge_Ah;
  truth.hotel_A = std::max(0.0, options.hotel_A + noise.normal(options.hotel_error_A));
  return {sim::Battery(truth), 1 + noise.normal(options.current_error), truth.hotel_A,
          noise.normal(options.voltage_error_V)};
}

config::BatterySettings thesis_battery() {
  config::BatterySettings options;
  options.curve_V = sim::Battery::Options{}.curve_V;
  return options;
}

TEST(GaugesOnMissions, ChargeCountedFromTheMotorsCurrent) {
  Score score;
  for (int mission = 0; mission < kMissions; ++mission) {
    sim::Noise noise(static_cast<std::uint64_t>(100 + mission));
    pipeline::BatteryEstimator estimator(thesis_battery());
    estimator.set({3.7, 0.074});
    Discharge truth = draw(noise, thesis_battery(), 3.7 - std::abs(noise.normal(0.074)));
    for (double t_s = 1; t_s <= kDuration_s; t_s += 0.5) {
      const double motor_A = survey().at(ns(t_s)).motor_current_A;
      truth.battery.draw(motor_A, 0.5);
      estimator.motor_current(ns(t_s), motor_A / truth.current_scale + noise.normal(0.02));
    }
    score.add(estimator.charge()->charge_Ah - truth.battery.charge_Ah(), estimator.charge()->std_Ah);
  }
  score.print("charge by the motor's current", "Ah");
  EXPECT_GE(score.share(), 0.85);
}

TEST(GaugesOnMissions, UnknownChargeFromTheGaugeAfterARest) {
  Score at_rest, at_end;
  for (int mission = 0; mission < kMissions; ++mission) {
    sim::Noise noise(static_cast<std::uint64_t>(200 + mission));
    pipeline::BatteryEstimator estimator(thesis_battery());
    Discharge truth = draw(noise, thesis_battery(), noise.uniform(1.0, 3.7));
    const auto read = [&](double t_s, double motor_A) {
      truth.battery.draw(motor_A, 0.5);
      const double current_A = (motor_A + truth.hotel_A) / truth.current_scale + noise.normal(0.02);
      const double voltage_V = truth.battery.voltage_V(motor_A) + truth.curve_error_V + noise.normal(0.02);
      estimator.gauge(ns(t_s), current_A, voltage_V);
    };
    constexpr double kRest_s = 120;
    for (double t_s = 1; t_s <= kRest_s; t_s += 0.5) read(t_s, 0);
    if (!estimator.charge()) continue;  // the hotel load is more than a rest
    at_rest.add(estimator.charge()->charge_Ah - truth.battery.charge_Ah(), estimator.charge()->std_Ah);
    for (double t_s = 0; t_s <= kDuration_s; t_s += 0.5)
      read(kRest_s + t_s + 1, survey().at(ns(t_s)).motor_current_A);
    at_end.add(estimator.charge()->charge_Ah - truth.battery.charge_Ah(), estimator.charge()->std_Ah);
  }
  at_rest.print("unknown charge after two minutes of rest", "Ah");
  at_end.print("the same after the mission", "Ah");
  EXPECT_GE(at_rest.all, kMissions / 2);
  EXPECT_GE(at_rest.share(), 0.85);
  EXPECT_GE(at_end.share(), 0.85);
}

/// Height straight down, with the true tilt disturbed as the filter is told, over floors with slopes up to
/// `slope`.
Score altitudes(double slope) {
  Score score;
  for (int mission = 0; mission < kMissions; ++mission) {
    sim::Noise noise(static_cast<std::uint64_t>(300 + mission));
    sim::Altimeter::Options options;
    options.floor.depth_m = noise.uniform(10, 40);
    options.floor.slope_north = noise.uniform(-slope, slope);
    options.floor.slope_east = noise.uniform(-slope, slope);
    options.noise_m = 0.1;
    options.seed = static_cast<std::uint64_t>(400 + mission);
    sim::Altimeter altimeter(options, survey());
    nav::AltitudeFilter filter{nav::AltitudeOptions()};
    const double pitch_error_rad = noise.normal(0.02), roll_error_rad = noise.normal(0.02);
    for (double t_s = 1; t_s <= kDuration_s; t_s += 0.2) {
      const sim::State state = survey().at(ns(t_s));
      if (const auto range_m = altimeter.measure_m(ns(t_s))) {
        (void)filter.take(ns(t_s), *range_m, state.euler_rad[1] + pitch_error_rad,
                          state.euler_rad[0] + roll_error_rad);
      }
      const auto altitude = filter.at(ns(t_s));
      if (t_s < 10 || !altitude) continue;
      const double truth_m =
          options.floor.depth_at_m(state.position_m[0], state.position_m[1]) - state.position_m[2];
      score.add(altitude->altitude_m - truth_m, altitude->std_m);
    }
  }
  return score;
}

TEST(GaugesOnMissions, AltitudeAboveLevelFloors) {
  const Score score = altitudes(0);
  score.print("altitude above level floors", "m");
  EXPECT_GE(score.share(), 0.85);
}

TEST(GaugesOnMissions, AltitudeAboveSlopes) {
  const Score score = altitudes(0.05);
  score.print("altitude above slopes up to 5 %", "m");
  EXPECT_LT(std::sqrt(score.squares / score.all), 0.5);
}

}  // namespace
}  // namespace navcal
