// SPDX-License-Identifier: Apache-2.0
// What holds for every effect of the library.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/effects/choice.h"
#include "sim/effects/effect_set.h"
#include "tests/sim/effects/at_rest.h"

namespace navcal::sim::testing {
namespace {

/// All that a set makes of one state, at several times.
std::vector<double> all_outputs(EffectSet& set) {
  std::vector<double> all;
  const auto add = [&](const auto& values) { all.insert(all.end(), values.begin(), values.end()); };
  State state = some_state();
  for (int i = 0; i < 4; ++i) {
    const double time_s = 10 + 5 * i;
    state.euler_rad[2] += 0.02;
    for (double& fin : state.fins_rad) fin = 0.1 * std::cos(i);
    const Instant now{time_s, state, 21};
    Vector3 world = state.field_world_uT, body{12.0 + i, -7, 43}, force = state.specific_force_m_s2;
    Tilt seen{0.1, -0.2}, said{0.1, -0.2};
    GyroRates rates{0.02, 0.4, -0.03, 0.4};
    double depth = 2;
    CardVoltages_mV voltages{2048, 2300, 2000, 2300, 2200, 2100, 1100, 600};
    AntennaMotion antenna{state.position_m, {1, 0.5, 0}};
    Influences on;
    Vector3 fins = state.fins_rad;
    set.earth_field(now, world);
    set.body_field(now, body);
    set.tilt_seen(now, seen);
    set.tilt_said(now, said);
    set.gyros(now, rates);
    set.accelerometers(now, force);
    set.depth(now, depth);
    set.card_voltages(now, voltages);
    set.antenna(now, antenna);
    set.influence(time_s, on);
    set.link_fins(time_s, 0.01, fins);
    add(world), add(body), add(rates), add(force), add(voltages), add(fins);
    add(antenna.position_m), add(antenna.velocity_m_s), add(on.current_m_s);
    const Delays late = set.delays(time_s);
    add(std::array{seen.roll_rad, seen.pitch_rad, said.roll_rad, said.pitch_rad, depth, late.card_s, late.gps_s,
                   on.thrust_factor, on.yaw_damping_per_s, on.buoyancy_N});
    for (const auto of : {Instrument::compass, Instrument::imu, Instrument::gps, Instrument::motor}) {
      const Transmission way = set.line(of, time_s);
      add(std::array{set.noise(of, time_s), set.slow_ppm(of, time_s), static_cast<double>(way.copies), way.late_s,
                     std::max(way.held_until_s, time_s)});
    }
  }
  return all;
}

EffectSet set_of(std::unique_ptr<Effect> effect, const Interval& when = {}) {
  EffectSet set;
  set.add(std::move(effect), when);
  return set;
}

/// So strong that whatever is random happens.
std::unique_ptr<Effect> strong(const EffectEntry& entry, double strength) {
  auto effect = entry.make();
  Noise noise(7);
  auto values = drawn_parameters(effect->description(), strength, noise);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::min(values[i], effect->description().parameters[i].greatest);
  }
  effect->set_parameters(values);
  return effect;
}

struct EveryEffect : ::testing::TestWithParam<EffectEntry> {};

TEST_P(EveryEffect, IsNeutralAtZeroAndOutsideItsInterval) {
  EffectSet none;
  const auto nominal = all_outputs(none);
  EffectSet neutral = set_of(GetParam().make());
  EXPECT_EQ(all_outputs(neutral), nominal);
  EffectSet early = set_of(strong(GetParam(), 1000), {100, 200});
  EXPECT_EQ(all_outputs(early), nominal);
  EffectSet late = set_of(strong(GetParam(), 1000), {0, 10});
  EXPECT_EQ(all_outputs(late), nominal);
}

TEST_P(EveryEffect, DoesSomethingWhenItIsStrong) {
  EffectSet none;
  EffectSet set = set_of(strong(GetParam(), 1000));
  EXPECT_NE(all_outputs(set), all_outputs(none));
}

TEST_P(EveryEffect, ACopyGoesOnFromTheSameStateAndApart) {
  EffectSet set = set_of(strong(GetParam(), 1));
  all_outputs(set);
  EffectSet copy = set;
  const std::vector<double> zeros(copy[0].parameters().size());
  const auto after = all_outputs(copy);
  EXPECT_EQ(all_outputs(set), after);
  copy[0].set_parameters(zeros);
  EXPECT_NE(set[0].parameters()[0], 0) << "what is done to the copy does not reach the original";
}

TEST_P(EveryEffect, DescribesItself) {
  const auto effect = GetParam().make();
  const EffectDescription& about = effect->description();
  EXPECT_EQ(about.name, GetParam().name) << "the file and the effect have one name";
  EXPECT_FALSE(about.equation.empty());
  EXPECT_EQ(about.parameters.size(), effect->parameters().size());
  ASSERT_EQ(about.parameters.size() % about.vector, 0U);
  for (const EffectParameter& parameter : about.parameters) {
    EXPECT_GT(parameter.typical, 0) << parameter.name;
    EXPECT_LE(parameter.typical, parameter.greatest) << parameter.name;
    EXPECT_LE(parameter.least, 0) << parameter.name << ": zero is neutral, so it must be allowed";
  }
}

INSTANTIATE_TEST_SUITE_P(Library, EveryEffect, ::testing::ValuesIn(effect_table().begin(), effect_table().end()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(EffectTable, HoldsWhatTheDiagnosisNeedsAndNoMoreIsSaidOfTheUnknown) {
  EXPECT_GE(effect_table().size(), 34U);
  EXPECT_EQ(make_effect("hard"), nullptr);
  EXPECT_NE(make_effect("fin_backlash"), nullptr);
}

}  // namespace
}  // namespace navcal::sim::testing
