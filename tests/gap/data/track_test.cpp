// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gap/verdict/diagnosis.h"

namespace navcal::gap {
namespace {

Trajectory10Hz straight(double heading_rad, double pitch_rad, std::size_t intervals) {
  Trajectory10Hz course;
  for (std::size_t i = 0; i < intervals; ++i) {
    course.time_s.push_back(kInterval_s * static_cast<double>(i));
    course.heading_rad.push_back(heading_rad);
    course.pitch_rad.push_back(pitch_rad);
    course.surge_m_s.push_back(2);
  }
  return course;
}

Mission with_fixes() {
  Mission mission;
  for (const double time_s : {5.0, 6.0}) {
    FixReading fix;
    fix.time_s = time_s;
    fix.position_m = {10 + time_s, 20};
    mission.fixes.push_back(fix);
  }
  return mission;
}

TEST(Track, ReckonsFromTheFirstFixOn) {
  const Mission mission = with_fixes();
  const Track track = reckoned_track(straight(std::numbers::pi / 2, std::numbers::pi / 3, 100), mission);
  ASSERT_EQ(track.time_s.size(), 50U);
  EXPECT_GE(track.time_s.front(), 5);
  EXPECT_NEAR(track.north_m.back(), 15, 1e-9);
  EXPECT_NEAR(track.east_m.back(), 20 + 5 * 1.0, 1e-9) << "5 s at 2 m/s, half of it level";
  EXPECT_EQ(track_of_fixes(mission).north_m, (std::vector<double>{15, 16}));
}

TEST(Track, WithoutFixesThereIsNone) {
  EXPECT_TRUE(reckoned_track(straight(0, 0, 10), {}).time_s.empty());
  EXPECT_TRUE(track_of_fixes({}).time_s.empty());
}

TEST(Track, WhatIsNoNumberMovesNothing) {
  Trajectory10Hz course = straight(0, 0, 100);
  course.heading_rad[70] = course.surge_m_s[80] = std::numeric_limits<double>::quiet_NaN();
  const Track track = reckoned_track(course, with_fixes());
  EXPECT_EQ(track.time_s.size(), 48U);
  EXPECT_TRUE(std::isfinite(track.north_m.back()));
}

}  // namespace
}  // namespace navcal::gap
