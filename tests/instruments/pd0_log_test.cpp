// SPDX-License-Identifier: Apache-2.0
// Doppler logs with PD0, frame by frame: each value is given here as the manual states it, and as navcal must
// understand it.

#include <gtest/gtest.h>

#include <cmath>

#include "base/angles.h"
#include "protocols/pd0.h"
#include "tests/instruments/collector.h"
#include "tests/instruments/velocity.h"

namespace navcal::instruments {
namespace {

namespace pd0 = protocols::pd0;
using Verdict = Instrument::Verdict;

constexpr std::uint8_t kAllSensors =
    pd0::temperature_sensor | pd0::roll_sensor | pd0::pitch_sensor | pd0::heading_sensor | pd0::depth_sensor;

/// An ensemble of a convex head of 30 degrees that looks down, level and at rest over a bottom at 10 m.
pd0::Ensemble ensemble_of(pd0::Axes axes) {
  pd0::Ensemble ensemble;
  ensemble.fixed.emplace();
  ensemble.fixed->system = 0x424B;
  ensemble.fixed->axes = axes;
  ensemble.fixed->used_sensors = ensemble.fixed->fitted_sensors = kAllSensors;
  ensemble.variable.emplace();
  ensemble.variable->speed_of_sound_m_s = 1485;
  ensemble.variable->temperature_C = 12.5;
  ensemble.bottom.emplace();
  for (auto& range_m : ensemble.bottom->range_m) range_m = 10;
  ensemble.bottom->velocity_m_s = {0.0, 0.0, 0.0, 0.0};
  return ensemble;
}

Collector read_ensembles(const std::vector<pd0::Ensemble>& ensembles) {
  Collector collector(protocols::Protocol::pd0);
  for (const auto& ensemble : ensembles) collector.feed<pd0::Parser>(pd0::encode(ensemble));
  return collector;
}

DvlSample only_dvl(const pd0::Ensemble& ensemble) {
  const auto found = read_ensembles({ensemble}).all<DvlSample>();
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? DvlSample{} : found.front();
}

TEST(Pd0Log, ShipAxesAreStarboardForwardUpOfTheBottom) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.bottom->velocity_m_s = {-0.1, -1.9, 0.05, 0.003};
  const DvlSample sample = only_dvl(ensemble);
  EXPECT_EQ(sample.frame, VelocityFrame::body);
  expect_velocity(sample.bottom_velocity_m_s, {1.9, 0.1, 0.05});
  EXPECT_FALSE(sample.bottom_velocity_std_m_s) << "one error velocity says little";
  EXPECT_FALSE(sample.water_velocity_m_s);
  EXPECT_NEAR(sample.altitude_m.value(), 10, 1e-9);
  EXPECT_NEAR(sample.temperature_C.value(), 12.5, 1e-9);
  EXPECT_NEAR(sample.sound_speed_m_s.value(), 1485, 1e-9);
}

TEST(Pd0Log, LevelShipAxesAreTurnedByItsOwnTiltOnly) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.fixed->uses_tilts = true;
  ensemble.variable->pitch_deg = 30;
  ensemble.bottom->velocity_m_s = {0.0, 0.0, -1.0, 0.0};  // the bottom falls away: the vehicle climbs
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {0.5, 0, -std::sqrt(3) / 2});
  // Tilts that the host has set were not those of this ping.
  ensemble.fixed->used_sensors = pd0::temperature_sensor;
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {0, 0, -1});
  ensemble.fixed->used_sensors = kAllSensors;
  ensemble.fixed->uses_tilts = false;
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {0, 0, -1});
}

TEST(Pd0Log, InstrumentAxesFollowAlignmentAndLookingUp) {
  auto ensemble = ensemble_of(pd0::Axes::instrument);
  ensemble.bottom->velocity_m_s = {0.0, -1.0, 0.25, 0.0};
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {1, 0, 0.25});
  ensemble.fixed->heading_alignment_deg = 90;  // beam 3 to starboard
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {0, 1, 0.25});
  ensemble.fixed->heading_alignment_deg = 0;
  ensemble.fixed->system |= 0x80;
  ensemble.bottom->velocity_m_s = {-0.5, -1.0, 0.25, 0.0};
  // The surface comes nearer: the vehicle rises. Its x axis points to port.
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {1, -0.5, -0.25});
  EXPECT_FALSE(only_dvl(ensemble).altitude_m) << "it sees the surface";
}

TEST(Pd0Log, EarthAxesAreEastNorthUp) {
  auto ensemble = ensemble_of(pd0::Axes::earth);
  ensemble.bottom->velocity_m_s = {-0.2, 0.3, 0.1, 0.0};
  const DvlSample sample = only_dvl(ensemble);
  EXPECT_EQ(sample.frame, VelocityFrame::earth);
  expect_velocity(sample.bottom_velocity_m_s, {-0.3, 0.2, 0.1});
}

TEST(Pd0Log, BeamsAreSolvedWithThreeOfThemAsWell) {
  auto ensemble = ensemble_of(pd0::Axes::beam);
  // Forward at 1 m/s: the bottom comes nearer along beam 3, which is 30 degrees from the vertical.
  ensemble.bottom->velocity_m_s = {0.0, 0.0, 0.5, -0.5};
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {1, 0, 0});
  for (std::size_t missing = 0; missing < 4; ++missing) {
    auto three = ensemble;
    three.bottom->velocity_m_s[missing].reset();
    expect_velocity(only_dvl(three).bottom_velocity_m_s, {1, 0, 0});
  }
  ensemble.bottom->velocity_m_s = {std::nullopt, 0.0, std::nullopt, -0.5};
  EXPECT_FALSE(only_dvl(ensemble).bottom_velocity_m_s);
  // Concave: the beams are crossed.
  ensemble.fixed->system = 0x4243;
  ensemble.bottom->velocity_m_s = {0.0, 0.0, 0.5, -0.5};
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {-1, 0, 0});
  // An angle that is not named stands at the end of the leader.
  ensemble.fixed->system = 0x434B;
  ensemble.fixed->stated_beam_angle_deg = 30;
  expect_velocity(only_dvl(ensemble).bottom_velocity_m_s, {1, 0, 0});
  ensemble.fixed->stated_beam_angle_deg = 0;
  EXPECT_FALSE(only_dvl(ensemble).bottom_velocity_m_s);
  EXPECT_FALSE(only_dvl(ensemble).altitude_m);
}

TEST(Pd0Log, WithoutBottomLockThereIsNoVelocity) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.bottom = pd0::BottomTrack{};
  const DvlSample sample = only_dvl(ensemble);
  EXPECT_FALSE(sample.bottom_velocity_m_s);
  EXPECT_FALSE(sample.altitude_m);
  EXPECT_TRUE(sample.temperature_C);
}

TEST(Pd0Log, WaterVelocityCountsWhereItWasMeasured) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.bottom->water_velocity_m_s = {0.0, -1.5, 0.0, 0.0};
  EXPECT_FALSE(only_dvl(ensemble).water_velocity_m_s) << "zeros are sent where no layer is asked for";
  ensemble.bottom->water_percent_good = {0, 0, 0, 100};
  expect_velocity(only_dvl(ensemble).water_velocity_m_s, {1.5, 0, 0});
}

TEST(Pd0Log, ErrorVelocityBecomesTheStatedError) {
  std::vector<pd0::Ensemble> ensembles;
  for (int i = 0; i < 40; ++i) {
    auto ensemble = ensemble_of(pd0::Axes::instrument);
    ensemble.bottom->velocity_m_s = {0.0, -1.0, 0.0, i % 2 == 0 ? 0.006 : -0.006};
    ensembles.push_back(ensemble);
  }
  auto three_beams = ensemble_of(pd0::Axes::instrument);
  three_beams.bottom->velocity_m_s = {0.0, -1.0, 0.0, std::nullopt};
  ensembles.push_back(three_beams);
  const auto samples = read_ensembles(ensembles).all<DvlSample>();
  EXPECT_FALSE(samples.at(3).bottom_velocity_std_m_s);
  EXPECT_NEAR(samples.at(39).bottom_velocity_std_m_s.value(), 0.006, 1e-6);
  EXPECT_NEAR(samples.at(40).bottom_velocity_std_m_s.value(), 0.006 * std::sqrt(3), 1e-6);
}

TEST(Pd0Log, OnlyWhatItMeasuresItselfIsAttitudeOrPressure) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.variable->heading_deg = 91.5;
  ensemble.variable->pitch_deg = 5;
  ensemble.variable->roll_deg = -10;
  ensemble.variable->pressure_Pa = 50000;
  const auto own = read_ensembles({ensemble});
  ASSERT_EQ(own.all<CompassSample>().size(), 1U);
  const CompassSample compass = own.all<CompassSample>().front();
  EXPECT_NEAR(compass.heading_rad.value(), 91.5 * base::kRadiansPerDegree, 1e-9);
  EXPECT_FALSE(compass.heading_is_true);
  EXPECT_NEAR(compass.roll_rad.value(), -10 * base::kRadiansPerDegree, 1e-9);
  EXPECT_NEAR(compass.pitch_rad.value(), std::atan(std::tan(5 * base::kRadiansPerDegree) * std::cos(0.17453292)),
              1e-6);
  ASSERT_EQ(own.all<DepthSample>().size(), 1U);
  EXPECT_NEAR(own.all<DepthSample>().front().pressure_Pa.value(), 151325, 1e-6);
  EXPECT_EQ(std::count_if(own.measurements.begin(), own.measurements.end(), [](const auto& m) { return m.paces; }),
            1);

  ensemble.fixed->fitted_sensors = pd0::temperature_sensor;
  const auto set_by_host = read_ensembles({ensemble});
  EXPECT_TRUE(set_by_host.all<CompassSample>().empty());
  EXPECT_TRUE(set_by_host.all<DepthSample>().empty());

  ensemble.fixed->fitted_sensors = kAllSensors;
  ensemble.fixed->heading_bias_deg = 3;
  ensemble.variable->pressure_Pa.reset();
  ensemble.variable->depth_m = 12.3;
  const auto short_leader = read_ensembles({ensemble});
  EXPECT_TRUE(short_leader.all<CompassSample>().front().heading_is_true);
  EXPECT_NEAR(short_leader.all<DepthSample>().front().depth_m.value(), 12.3, 1e-9);
}

TEST(Pd0Log, WhatCannotBeIsCountedAndTheRestIsUsed) {
  auto ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.variable->heading_deg = 400;
  const auto seen = read_ensembles({ensemble});
  EXPECT_EQ(seen.verdicts.front(), Verdict::out_of_range);
  EXPECT_TRUE(seen.all<CompassSample>().empty());
  EXPECT_TRUE(seen.all<DvlSample>().front().bottom_velocity_m_s);

  ensemble = ensemble_of(pd0::Axes::ship);
  ensemble.bottom->velocity_m_s = {0.0, 25.0, 0.0, 0.0};
  ensemble.variable->speed_of_sound_m_s = 0;
  const auto fast = read_ensembles({ensemble});
  EXPECT_EQ(fast.verdicts.front(), Verdict::out_of_range);
  EXPECT_FALSE(fast.all<DvlSample>().front().bottom_velocity_m_s);
  EXPECT_FALSE(fast.all<DvlSample>().front().sound_speed_m_s);
  EXPECT_TRUE(fast.all<DvlSample>().front().altitude_m);
}

}  // namespace
}  // namespace navcal::instruments
