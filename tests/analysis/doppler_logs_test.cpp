// SPDX-License-Identifier: Apache-2.0
// Doppler logs on the simulated vehicle, to their samples.
#include <gtest/gtest.h>

#include <cmath>

#include "protocols/pd0.h"
#include "sim/instruments/doppler_devices.h"
#include "sim/instruments/emulators.h"
#include "sim/instruments/pressure_gauges.h"
#include "sim/rotation.h"
#include "tests/analysis/one_port.h"
#include "tests/sim/drive.h"

namespace navcal::analysis {
namespace {

using instruments::CompassSample;
using instruments::DepthSample;
using instruments::DvlSample;
using protocols::Protocol;
using sim::operator*;
using sim::testing::kSecond_ns;
using sim::testing::kStart_ns;
namespace pd0 = protocols::pd0;

/// Under way in a current, tilted and turning nowhere.
struct Tilted : sim::testing::Still {
  Tilted() {
    state.position_m = {0, 0, 5};
    state.euler_rad = {0.12, -0.2, 2.2};
    state.velocity_body_m_s = {1.4, 0.1, -0.06};
    state.current_m_s = {0.2, -0.3};
  }
};

sim::Vector3 mean_of(const std::vector<sim::Vector3>& all) {
  sim::Vector3 mean{};
  for (const auto& one : all) {
    for (std::size_t i = 0; i < 3; ++i) mean[i] += one[i] / static_cast<double>(all.size());
  }
  return mean;
}

std::vector<sim::Vector3> bottom_velocities(const OnePort& port) {
  std::vector<sim::Vector3> all;
  for (const DvlSample& sample : port.all<DvlSample>()) {
    if (sample.bottom_velocity_m_s) all.push_back(*sample.bottom_velocity_m_s);
  }
  return all;
}

/// Spread of one component, m/s.
double spread(const std::vector<sim::Vector3>& all, std::size_t component) {
  const double mean = mean_of(all)[component];
  double square = 0;
  for (const auto& one : all) square += (one[component] - mean) * (one[component] - mean);
  return std::sqrt(square / static_cast<double>(all.size()));
}

void expect_close(const sim::Vector3& found, const sim::Vector3& expected) {
  // Scale error of 0.2 %, noise of the mean of some hundred pings, and steps of the attitude.
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 0.006) << i;
}

TEST(DopplerLogs, Pd0IsUnderstoodInAllItsAxes) {
  const Tilted motion;
  for (const auto axes : {pd0::Axes::beam, pd0::Axes::instrument, pd0::Axes::ship, pd0::Axes::earth}) {
    for (const bool convex : {true, false}) {
      for (const bool uses_tilts : {true, false}) {
        sim::Pd0Doppler::Options options;
        options.axes = axes;
        options.convex = convex;
        options.uses_tilts = uses_tilts;
        sim::Pd0Doppler log(options, motion);
        OnePort port(Protocol::pd0);
        port.run(log, 60);
        const auto velocities = bottom_velocities(port);
        ASSERT_EQ(velocities.size(), 300U);
        const sim::Vector3 body = sim::velocity_over_bottom_m_s(motion.state);
        if (axes == pd0::Axes::earth) {
          expect_close(mean_of(velocities),
                       sim::R_world_from_body({0.12, -0.2, magnetic_heading_rad(motion.state)}) * body);
        } else {
          expect_close(mean_of(velocities), body);
        }
        const auto last = port.all<DvlSample>().back();
        EXPECT_NEAR(last.altitude_m.value(), 15, 0.1);
        if (axes != pd0::Axes::earth) {
          EXPECT_NEAR(last.bottom_velocity_std_m_s.value() / spread(velocities, 0), 1, 0.6)
              << "stated and true error";
        }
        EXPECT_EQ(port.statistics().out_of_range, 0U);
        EXPECT_EQ(port.statistics().bytes.skipped_bytes, 0U);
      }
    }
  }
}

TEST(DopplerLogs, Pd0GivesAttitudeAndPressure) {
  const Tilted motion;
  sim::Pd0Doppler log({}, motion);
  OnePort port(Protocol::pd0);
  port.run(log, 5);
  const CompassSample compass = port.all<CompassSample>().back();
  EXPECT_NEAR(compass.heading_rad.value(), sim::magnetic_heading_rad(motion.state), 1e-4);
  EXPECT_NEAR(compass.pitch_rad.value(), -0.2, 1e-4);
  EXPECT_NEAR(compass.roll_rad.value(), 0.12, 1e-4);
  EXPECT_NEAR(port.all<DepthSample>().back().pressure_Pa.value(), sim::absolute_pressure_Pa(motion.state), 10);
}

TEST(DopplerLogs, Pd6AndWaterLinkedGiveTheSameVelocity) {
  const Tilted motion;
  sim::Pd6Doppler pd6({}, motion);
  sim::WaterLinkedDoppler water_linked({}, motion);
  for (const auto& [log, protocol] :
       {std::pair<sim::Device*, Protocol>{&pd6, Protocol::pd6}, {&water_linked, Protocol::water_linked}}) {
    OnePort port(protocol);
    port.run(*log, 60);
    const auto velocities = bottom_velocities(port);
    ASSERT_EQ(velocities.size(), 300U);
    expect_close(mean_of(velocities), sim::velocity_over_bottom_m_s(motion.state));
    const double std_m_s = port.all<DvlSample>().back().bottom_velocity_std_m_s.value();
    EXPECT_NEAR(std_m_s / spread(velocities, 0), 1, 0.6);
    EXPECT_EQ(port.statistics().out_of_range, 0U);
    EXPECT_EQ(port.statistics().bytes.skipped_bytes, 0U);
  }
}

TEST(DopplerLogs, BottomLockComesAndGoes) {
  struct Diving : sim::testing::Still {
    [[nodiscard]] sim::State at(std::int64_t t_ns) const override {
      sim::State now = state;
      now.velocity_body_m_s = {1, 0, 1};
      now.position_m[2] = static_cast<double>(t_ns - kStart_ns) * 1e-9;
      return now;
    }
  };
  const Diving motion;
  for (const Protocol protocol : {Protocol::pd0, Protocol::pd6, Protocol::water_linked}) {
    sim::EmulatorOptions options;
    options.floor.depth_m = 60;
    const auto log = sim::make_emulator(protocol, options, motion);
    OnePort port(protocol);
    port.run(*log, 40);
    const auto samples = port.all<DvlSample>();
    EXPECT_FALSE(samples.front().bottom_velocity_m_s);
    EXPECT_FALSE(samples.front().altitude_m);
    ASSERT_TRUE(samples.back().bottom_velocity_m_s);
    EXPECT_NEAR(samples.back().altitude_m.value(), 20, 0.3);
    EXPECT_NEAR((*samples.back().bottom_velocity_m_s)[2], 1, 0.03) << "down is positive";
  }
}

TEST(DopplerLogs, WaterLinkedStatesItsAge) {
  const Tilted motion;
  for (const double latency_s : {0.02, 0.3}) {
    sim::DopplerLog::Options options;
    options.latency_s = latency_s;
    sim::WaterLinkedDoppler log(options, motion);
    OnePort port(Protocol::water_linked);
    port.run(log, 3);
    ASSERT_FALSE(port.samples.empty());
    for (std::size_t i = 0; i < port.samples.size(); ++i) {
      const std::int64_t measured_ns =
          kStart_ns + static_cast<std::int64_t>(i + 1) * kSecond_ns / 5 - std::llround(latency_s * 1e9);
      // The whole ping was one read: the first line of it lies in the middle of the others.
      EXPECT_NEAR(static_cast<double>(port.samples[i].stamp.validity_ns - measured_ns), 0, 20e6);
    }
  }
}

}  // namespace
}  // namespace navcal::analysis
