// SPDX-License-Identifier: Apache-2.0
// The only place where both realities meet: they were written apart, and must come to the same.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "config/vehicle.h"
#include "sim/effects/effect_set.h"
#include "sim/effects/effect_table.h"
#include "sim/path.h"
#include "sim/vehicle/drive_helm.h"
#include "sim/vehicle/simulated_motion.h"
#include "tests/validation/reference/bench.h"

namespace navcal::reference::testing {
namespace {

/// Fins and shaft that go where they like, a row each step of the simulator.
std::vector<sim::PathRow> random_drive(double duration_s, std::uint64_t seed) {
  Rng dice(seed, 0);
  std::vector<sim::PathRow> rows;
  Vector3 fins = Vector3::Zero(), command = Vector3::Zero();
  double shaft = 10, shaft_command = 10;
  for (int k = 0; k * 0.01 <= duration_s; ++k) {
    if (k % 100 == 0) {
      command = FinLinkage::mixed(dice.normal(0.12), dice.normal(0.06));
      shaft_command = dice.uniform(8, 16);
    }
    fins += 0.06 * (command - fins);
    shaft += 0.02 * (shaft_command - shaft);
    sim::PathRow row;
    row.t_s = 0.01 * k;
    row.velocity_body_m_s = {1, 0, 0};
    row.rpm = 60 * shaft;
    row.fins_rad = {fins.x(), fins.y(), fins.z()};
    rows.push_back(row);
  }
  return rows;
}

sim::State swum_by_sim(const std::vector<sim::PathRow>& rows, sim::EffectSet& effects) {
  sim::MotionOptions options;
  options.influencer = &effects;
  const sim::SimulatedMotion motion(config::VehicleSettings{}, std::make_unique<sim::DriveHelm>(rows), options);
  return motion.at(std::llround(rows.back().t_s * 1e9));
}

Snapshot swum_by_trial(const std::vector<sim::PathRow>& rows, const VehicleDeviations& deviations) {
  Start start;
  start.velocity_m_s = {1, 0, 0};
  Vehicle vehicle(Hull{}, deviations, start);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const auto& fins = rows[k + 1].fins_rad;
    vehicle.hold(rows[k].rpm / 60, {fins[0], fins[1], fins[2]});
    vehicle.advance(rows[k + 1].t_s);
  }
  return vehicle.snapshot();
}

void expect_agreement(const sim::State& sim, const Snapshot& trial, double metres, double degrees) {
  const Vector3 place(sim.position_m[0], sim.position_m[1], sim.position_m[2]);
  EXPECT_LT((place - trial.position_m).norm(), metres);
  EXPECT_LT(std::abs(std::remainder(sim.euler_rad[2] - trial.heading_rad(), 2 * std::numbers::pi)),
            degrees * kDegree);
}

/// The simulator's effect with the parameters of ours.
std::unique_ptr<sim::Effect> counterpart(const Effect& effect) {
  auto same = sim::make_effect(effect.name);
  if (!same) return nullptr;
  std::vector<double> values;
  for (const auto& parameter : same->description().parameters) {
    const auto ours = effect.parameters.find(parameter.name);
    values.push_back(ours != effect.parameters.end() ? ours->second : 0);
  }
  same->set_parameters(values);
  return same;
}

TEST(Agreement, BothVehiclesSwimTheSameWay) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto rows = random_drive(50, seed);
    sim::EffectSet none;
    expect_agreement(swum_by_sim(rows, none), swum_by_trial(rows, {}), 0.01, 0.05);
  }
}

TEST(Agreement, EffectsHaveTheSameNamesParametersAndStrengths) {
  for (const EffectKind& kind : library_effects()) {
    const auto same = sim::make_effect(kind.name);
    ASSERT_TRUE(same) << kind.name;
    const auto& parameters = same->description().parameters;
    ASSERT_EQ(parameters.size(), kind.parameters.size()) << kind.name;
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
      EXPECT_EQ(parameters[i].name, kind.parameters[i]) << kind.name;
      const double norm = kind.size.symmetric && i >= 3 ? std::numbers::sqrt2 : 1;
      EXPECT_NEAR(parameters[i].typical * norm, kind.size.typical, 1e-12) << kind.name;
    }
    if (parameters.size() == kind.parameters.size()) {
      EXPECT_EQ(same->description().vector, kind.size.group) << kind.name;
    }
  }
  for (const EffectKind& kind : foreign_effects()) EXPECT_FALSE(sim::make_effect(kind.name)) << kind.name;
}

TEST(Agreement, EffectsOnTheVehicleTakeBothTheSameWay) {
  const auto rows = random_drive(20, 4);
  const Snapshot nominal = swum_by_trial(rows, {});
  Rng dice(5, 0);
  for (const char* const name : {"water_current", "thrust_scale", "fin_offset", "elevator_offset", "fin_lag",
                                 "fin_gain", "fin_backlash", "yaw_damping", "buoyancy"}) {
    SCOPED_TRACE(name);
    const Effect effect = drawn(*find_effect(name), 1, dice);
    sim::EffectSet effects;
    effects.add(counterpart(effect));
    const Snapshot trial = swum_by_trial(rows, with(effect.name, effect.parameters).vehicle);
    const double moved_m = (trial.position_m - nominal.position_m).norm();
    EXPECT_GT(moved_m, 0.02);
    expect_agreement(swum_by_sim(rows, effects), trial, 0.01 + 0.02 * moved_m, 0.5);
  }
}

sim::State state_of(const Snapshot& s) {
  const auto array = [](const Vector3& v) { return sim::Vector3{v.x(), v.y(), v.z()}; };
  sim::State state;
  state.position_m = array(s.position_m);
  state.euler_rad = {s.roll_rad(), s.pitch_rad(), s.heading_rad()};
  state.velocity_body_m_s = array(s.velocity_m_s);
  state.rate_rad_s = array(s.rate_rad_s);
  state.specific_force_m_s2 = array(s.acceleration_m_s2 - kGravity_m_s2 * s.down());
  state.motor_current_A = s.motor_current_A;
  return state;
}

/// Voltages that the simulator's card would convert at this instant, in mV.
sim::CardVoltages_mV voltages(sim::EffectSet& effects, const sim::Instant& now) {
  const sim::State& s = now.state;
  sim::GyroRates rates{s.rate_rad_s[0], s.rate_rad_s[2], s.rate_rad_s[1], s.rate_rad_s[2]};
  sim::Vector3 force = s.specific_force_m_s2;
  double depth_m = s.position_m[2];
  effects.gyros(now, rates);
  effects.accelerometers(now, force);
  effects.depth(now, depth_m);
  sim::CardVoltages_mV mV{};
  for (std::size_t i = 0; i < 4; ++i) mV[i] = 2048 + 10 / kDegree * rates[i];
  for (std::size_t i = 0; i < 3; ++i) mV[4 + i] = 2048 + 1000 / kGravity_m_s2 * force[i];
  mV[7] = 250 + 187.5 * depth_m;
  effects.card_voltages(now, mV);
  return mV;
}

TEST(Agreement, EffectsOnTheCardAreTheSame) {
  const World world = swung(20);
  Rng dice(6, 0);
  for (const char* const name : {"gyro_scale", "gyro_temperature", "gyro_drift", "gyro_g_sensitivity",
                                 "gyro_cross_axis", "gyro_nonlinearity", "accel_bias", "accel_scale",
                                 "accel_vibration", "adc_droop", "depth_scale", "depth_temperature"}) {
    const Effect effect = drawn(*find_effect(name), 2, dice);
    sim::EffectSet effects;
    effects.add(counterpart(effect));
    for (const CardSample& sample : card_along(world, with(effect.name, effect.parameters).card)) {
      const Snapshot s = world.at(sample.time_s);
      const sim::State state = state_of(s);
      const auto mV = voltages(effects, {s.time_s, state, s.electronics_C});
      for (std::size_t i = 0; i < 8; ++i) {
        const double reading = i < 4   ? 2048 + 10 / kDegree * sample.values[i]
                               : i < 7 ? 2048 + 1000 / kGravity_m_s2 * sample.values[i]
                                       : 250 + 187.5 * sample.values[i];
        ASSERT_NEAR(reading, mV[i], 0.51 / 16) << name << " channel " << i << " at " << s.time_s;
      }
    }
  }
}

/// The field that the simulator's compass would feel at this time.
Vector3 felt_field_uT(const World& world, sim::EffectSet& effects, double time_s) {
  const Snapshot s = world.at(time_s);
  const sim::State state = state_of(s);
  const sim::Instant now{time_s, state, s.electronics_C};
  sim::Vector3 earth = state.field_world_uT;
  effects.earth_field(now, earth);
  const Vector3 body = s.world_from_body.conjugate() * Vector3(earth[0], earth[1], earth[2]);
  sim::Vector3 field{body.x(), body.y(), body.z()};
  effects.body_field(now, field);
  return {field[0], field[1], field[2]};
}

TEST(Agreement, EffectsOnTheFieldAreTheSame) {
  const World world = swung(20);
  Rng dice(7, 0);
  for (const char* const name : {"hard_iron", "soft_iron", "compass_misalignment", "declination", "motor_field",
                                 "magnetic_hysteresis", "mag_temperature", "compass_lag"}) {
    const Effect effect = drawn(*find_effect(name), 2, dice);
    sim::EffectSet effects;
    effects.add(counterpart(effect));
    double felt_s = 0;
    felt_field_uT(world, effects, felt_s);
    for (const CompassSample& sample : compass_along(world, with(effect.name, effect.parameters).compass)) {
      // Effects with memory must be advanced along, as the simulator's compass does.
      while (felt_s + 0.01 < sample.time_s) felt_field_uT(world, effects, felt_s += 0.01);
      felt_s = sample.time_s;
      ASSERT_LT((sample.field_uT - felt_field_uT(world, effects, felt_s)).cwiseAbs().maxCoeff(), 0.04)
          << name << " at " << felt_s;
    }
  }
}

}  // namespace
}  // namespace navcal::reference::testing
