// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/covariates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "gap/replay/regimes.h"

namespace navcal::gap {
namespace {

constexpr std::size_t kIntervals = 1200;
/// step: the time since an order; lag: a derivative, a low-pass or the direction of a move.
constexpr std::array<std::string_view, 12> kFamilies{"constant", "heading", "rate",        "tilt",
                                                     "speed",    "current", "temperature", "depth",
                                                     "command",  "time",    "step",        "lag"};

/// A course that turns, dives and changes its speed, or one on which nothing happens.
Trajectory10Hz course_of(bool moves, std::size_t intervals = kIntervals) {
  Trajectory10Hz course;
  for (std::size_t i = 0; i < intervals; ++i) {
    const double t = kInterval_s * static_cast<double>(i), move = moves ? 1 : 0;
    course.time_s.push_back(t);
    course.heading_rad.push_back(move * 0.12 * t);
    course.yaw_rate_rad_s.push_back(move * (0.12 + 0.08 * std::sin(t / 3)));
    course.pitch_rate_rad_s.push_back(move * 0.05 * std::cos(t / 5));
    course.roll_rad.push_back(move * 0.05 * std::sin(t / 4));
    course.pitch_rad.push_back(move * 0.2 * std::sin(t / 5));
    course.depth_m.push_back(2 + move * std::sin(t / 9));
    course.surge_m_s.push_back(1 + move * 0.3 * std::sin(t / 20));
    course.current_A.push_back(1 + move * 0.5 * std::sin(t / 20));
    course.temperature_rise_C.push_back(move * t / 20);
    course.rudder_rad.push_back(move * 0.2 * std::sin(t / 3));
    course.elevator_rad.push_back(move * 0.1 * std::cos(t / 5));
    course.shaft_rps.push_back(8 + move * (i % 300 < 150 ? 3.0 : 0.0));
  }
  return course;
}

TEST(Covariates, AreScaledAndNamedOnce) {
  std::set<std::string> names;
  for (const Covariate& each : covariates_of(course_of(true))) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    ASSERT_EQ(each.values.size(), static_cast<Eigen::Index>(kIntervals)) << each.name;
    ASSERT_TRUE(each.values.allFinite()) << each.name;
    EXPECT_TRUE(each.varies) << each.name;
    if (each.name != "constant") {
      EXPECT_NEAR(each.values.mean(), 0, 1e-9) << each.name;
    }
    EXPECT_NEAR(each.values.squaredNorm() / static_cast<double>(kIntervals), 1, 1e-9) << each.name;
    ASSERT_FALSE(each.families.empty()) << each.name;
    for (const std::string_view family : each.families) {
      EXPECT_EQ(std::count(kFamilies.begin(), kFamilies.end(), family), 1) << family;
    }
    EXPECT_EQ(std::count(regimes().begin(), regimes().end(), each.regime), 1) << each.name << ": " << each.regime;
  }
}

TEST(Covariates, EachFamilyHasOneAndSomeAreBasic) {
  const std::vector<Covariate> all = covariates_of(course_of(true));
  for (const std::string_view family : kFamilies) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Covariate& each) {
      return std::count(each.families.begin(), each.families.end(), family) > 0;
    })) << family;
  }
  // Each name of the list of basic ones is that of a covariate.
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const Covariate& each) { return each.is_basic; }), 20);
}

TEST(Covariates, OfACourseOnWhichNothingHappensOnlyTheConstantVaries) {
  for (const Covariate& each : covariates_of(course_of(false))) {
    ASSERT_TRUE(each.values.allFinite()) << each.name;
    const bool is_of_time = each.families == std::vector<std::string_view>{"time"};
    EXPECT_EQ(each.varies, each.name == "constant" || is_of_time) << each.name;
  }
}

TEST(Covariates, TheListIsTheSameForEachCourse) {
  const auto moving = covariates_of(course_of(true)), still = covariates_of(course_of(false));
  ASSERT_EQ(moving.size(), still.size());
  for (std::size_t i = 0; i < moving.size(); ++i) EXPECT_EQ(moving[i].name, still[i].name);
}

TEST(Covariates, OfShortCoursesAreFinite) {
  EXPECT_TRUE(covariates_of(Trajectory10Hz()).empty());
  for (const std::size_t intervals : {1U, 2U, 3U}) {
    for (const Covariate& each : covariates_of(course_of(true, intervals))) {
      EXPECT_TRUE(each.values.allFinite()) << each.name << ' ' << intervals;
    }
  }
}

}  // namespace
}  // namespace navcal::gap
