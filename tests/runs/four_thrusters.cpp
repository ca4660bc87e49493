// SPDX-License-Identifier: Apache-2.0
#include "tests/runs/four_thrusters.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "base/angles.h"

namespace navcal::runs::test {
namespace {

constexpr double kStep_s = 0.05, kStart_s = 0.3, kThrustLag_s = 0.15;
// Accelerations at 100 us and 12 V, and damping.
constexpr double kHeave_m_s2 = 0.12, kHeaveDamping_per_s = 0.8, kYaw_rad_s2 = 1.0, kYawDamping_per_rad = 2;
constexpr double kTiltOfThrust_rad = 0.05;

}  // namespace

Run make_run(const Trait& trait, std::uint32_t seed, const std::string& name) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto rows = static_cast<Eigen::Index>(std::lround(trait.seconds / kStep_s));
  Run run;
  run.name = name;
  for (Eigen::VectorXd* series : {&run.clock_s, &run.depth_m, &run.pressure, &run.battery_V, &run.roll_rad,
                                  &run.pitch_rad, &run.yaw_rate_rad_s}) {
    series->setZero(rows);
  }
  run.command_us.resize(rows, 4);
  const double phase = std::uniform_real_distribution<double>(0, 6.28)(random);
  const double run_gain = 1 + 0.05 * trait.noise * normal(random);
  std::array<double, 4> thrust{};
  double depth_m = 0, sink_m_s = 0, yaw_rate = 0, roll = 0;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double time_s = static_cast<double>(row) * kStep_s;
    const bool runs = time_s >= kStart_s;
    const double command_us = runs ? trait.command_us : trait.stop_us;
    const double wanted = std::pow((command_us - trait.stop_us) / 100, 2) * std::pow(trait.battery_V / 12, 2);
    double sum = 0;
    for (std::size_t i = 0; i < thrust.size(); ++i) {
      thrust[i] += kStep_s / kThrustLag_s * (wanted * (i == 0 ? 1 - trait.lost_thrust : 1) - thrust[i]);
      sum += thrust[i] / 4;
    }
    // At rest the vehicle floats: the weight shows once the thrusters pull it under.
    const double weight = runs ? trait.weight_share * wanted : 0;
    sink_m_s +=
        kStep_s * (kHeave_m_s2 * trait.heave_gain * run_gain * (sum + weight) - kHeaveDamping_per_s * sink_m_s);
    depth_m += kStep_s * sink_m_s;
    const double moment = sum + 1.5 * (thrust[1] - thrust[0]);
    yaw_rate +=
        kStep_s * (-kYaw_rad_s2 * trait.yaw_gain * moment - kYawDamping_per_rad * yaw_rate * std::abs(yaw_rate));
    roll += kStep_s / 0.5 * (kTiltOfThrust_rad * (-sum + (thrust[0] - thrust[1])) - roll);
    run.clock_s[row] = std::floor(trait.clock_s + time_s);
    run.command_us.row(row).setConstant(command_us);
    run.depth_m[row] =
        std::round(100 * (depth_m + trait.depth_zero_m + 0.015 * trait.noise * normal(random))) / 100;
    run.pressure[row] = std::round(trait.surface_pressure + 106 * depth_m + 0.3 * normal(random));
    run.battery_V[row] = trait.battery_V;
    run.roll_rad[row] = trait.roll_rest_rad + roll + 0.01 * trait.noise * normal(random);
    run.pitch_rad[row] = trait.pitch_rest_rad + 0.01 * trait.noise * normal(random);
    const double ripple = runs ? trait.ripple_rad_s * std::sin(2 * std::numbers::pi * 4.1 * time_s + phase) : 0;
    run.yaw_rate_rad_s[row] = yaw_rate + ripple + 0.02 * trait.noise * normal(random);
  }
  return run;
}

std::string run_text(const Run& run) {
  std::string text =
      "time,pwm1,pwm2,pwm3,pwm4,depth,press,voltage,roll,pitch,yaw,a_x,a_y,a_z,w_row,w_pitch,w_yaw\n";
  for (Eigen::Index row = 0; row < run.rows(); ++row) {
    const auto second = static_cast<int>(run.clock_s[row]);
    text += fmt::format("{:06}", second / 3600 * 10000 + second / 60 % 60 * 100 + second % 60);
    for (Eigen::Index i = 0; i < run.command_us.cols(); ++i)
      text += fmt::format(",{:.0f}", run.command_us(row, i));
    text += fmt::format(",{:.2f},{:.0f},{:.2f},{:.4f},{:.4f},0,0,0,9.8,0,0,{:.4f}\n", run.depth_m[row],
                        run.pressure[row], run.battery_V[row], run.roll_rad[row] * base::kDegreesPerRadian,
                        run.pitch_rad[row] * base::kDegreesPerRadian,
                        run.yaw_rate_rad_s[row] * base::kDegreesPerRadian);
  }
  return text;
}

std::vector<Run> session_of(Trait trait, int runs, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  trait.heave_gain *= 1 + 0.04 * normal(random);
  trait.yaw_gain *= 1 + 0.1 * normal(random);
  trait.roll_rest_rad += 0.03 * normal(random);
  trait.pitch_rest_rad += 0.03 * normal(random);
  trait.surface_pressure += 10 * normal(random);
  std::vector<Run> made;
  for (int i = 0; i < runs; ++i) {
    trait.clock_s += 90;
    trait.battery_V -= 0.01;
    made.push_back(make_run(trait, static_cast<std::uint32_t>(random()), fmt::format("s{}_{}", seed, i)));
  }
  return made;
}

std::vector<Run> nominal_runs(int sessions, int runs_of_a_session, std::uint32_t seed) {
  std::vector<Run> all;
  for (int i = 0; i < sessions; ++i) {
    Trait trait;
    // Commands differ from session to session, which must not matter; days overlap on the clock.
    trait.command_us = 1190 + 4 * i;
    trait.clock_s = 50000 + 37 * i;
    const auto session = session_of(trait, runs_of_a_session, seed + static_cast<std::uint32_t>(i));
    all.insert(all.end(), session.begin(), session.end());
  }
  return all;
}

}  // namespace navcal::runs::test
