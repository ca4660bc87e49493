// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/error_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "gap/data/innovations.h"
#include "gap/replay/regimes.h"
#include "sim/effects/effect_set.h"

namespace navcal::gap {
namespace {

sim::EffectSet error_of(ErrorPlace place, double amplitude, Eigen::VectorXd series, double begin_s = 0) {
  sim::EffectSet set;
  set.add(std::make_unique<TimedError>(place, std::make_shared<const Eigen::VectorXd>(std::move(series)), begin_s))
      .set_parameters(std::span(&amplitude, 1));
  return set;
}

/// All that effects may change, in one row.
std::vector<double> all_at(sim::EffectSet set, double time_s) {
  const sim::State state;
  const sim::Instant now{time_s, state};
  std::vector<double> row;
  const auto append = [&](const auto& values) { row.insert(row.end(), values.begin(), values.end()); };
  sim::Vector3 world{20, 1, 40}, body{20, 1, 40}, force{0, 0, -9.8}, fins{};
  sim::Tilt tilt;
  sim::GyroRates rates{};
  sim::AntennaMotion motion;
  sim::Influences on;
  double depth_m = 2;
  set.earth_field(now, world);
  set.body_field(now, body);
  set.tilt_said(now, tilt);
  set.gyros(now, rates);
  set.accelerometers(now, force);
  set.depth(now, depth_m);
  set.antenna(now, motion);
  set.influence(time_s, on);
  set.link_fins(time_s, 0.01, fins);
  append(world);
  append(body);
  append(std::vector{tilt.roll_rad, tilt.pitch_rad});
  append(rates);
  append(force);
  append(std::vector{depth_m});
  append(motion.position_m);
  append(motion.velocity_m_s);
  append(std::vector{on.thrust_factor, on.yaw_damping_per_s, on.buoyancy_N});
  append(on.current_m_s);
  append(fins);
  return row;
}

std::vector<std::size_t> changed_by(ErrorPlace place) {
  const std::vector<double> before = all_at(sim::EffectSet(), 1);
  const std::vector<double> after = all_at(error_of(place, 0.1, Eigen::VectorXd::Ones(100)), 1);
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] != after[i]) changed.push_back(i);
  }
  return changed;
}

TEST(ErrorSources, EachComponentChangesItsOwnQuantity) {
  std::set<std::vector<std::size_t>> seen;
  for (const ErrorSource& source : error_sources()) {
    for (const ErrorComponent& component : source.components) {
      const auto changed = changed_by(component.place);
      EXPECT_FALSE(changed.empty()) << source.name << ' ' << component.name;
      const bool is_moment = source.name == "vehicle.moments";
      // Rudder and ailerons both move all three fins.
      EXPECT_TRUE(seen.insert(changed).second || is_moment) << source.name << ' ' << component.name;
    }
  }
}

TEST(ErrorSources, NamesAreOnceAndChannelsAreReported) {
  std::set<std::string_view> names;
  for (const ErrorSource& source : error_sources()) {
    EXPECT_TRUE(names.insert(source.name).second) << source.name;
    for (const ErrorComponent& component : source.components) {
      EXPECT_GT(component.typical, 0);
      if (component.channel.empty()) continue;
      EXPECT_TRUE(std::any_of(reported_channels().begin(), reported_channels().end(),
                              [&](const ReportedChannel& channel) { return channel.name == component.channel; }))
          << component.channel;
    }
  }
}

TEST(TimedError, IsInterpolatedAndKeepsItsEnds) {
  const Eigen::VectorXd series = Eigen::Vector3d(1, 3, -1);
  const auto depth_at = [&](double time_s) {
    auto set = error_of(ErrorPlace::depth, 2, series, 10);
    double depth_m = 0;
    const sim::State state;
    set.depth({time_s, state}, depth_m);
    return depth_m;
  };
  EXPECT_DOUBLE_EQ(depth_at(0), 2);
  EXPECT_DOUBLE_EQ(depth_at(10), 2);
  EXPECT_NEAR(depth_at(10 + kInterval_s / 2), 4, 1e-9);
  EXPECT_NEAR(depth_at(10 + kInterval_s), 6, 1e-9);
  EXPECT_NEAR(depth_at(10 + 1.5 * kInterval_s), 2, 1e-9);
  EXPECT_DOUBLE_EQ(depth_at(1000), -2);
}

TEST(TimedError, AHeadingErrorTurnsTheFieldAndKeepsItsSize) {
  auto set = error_of(ErrorPlace::heading, 0.1, Eigen::VectorXd::Ones(10));
  sim::Vector3 field{20, 0, 40};
  const sim::State state;
  set.earth_field({0.5, state}, field);
  EXPECT_NEAR(std::hypot(field[0], field[1]), 20, 1e-12);
  EXPECT_DOUBLE_EQ(field[2], 40);
  // Heading is minus the azimuth of the field as the compass sees it.
  EXPECT_NEAR(-std::atan2(field[1], field[0]), 0.1, 1e-12);
}

}  // namespace
}  // namespace navcal::gap
