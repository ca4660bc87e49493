// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/validation/reference/bench.h"

namespace navcal::reference::testing {
namespace {

constexpr double kReceiverDuration_s = 40;
constexpr double kPlaceStep_m = 0.03;  ///< a milliarcsecond
constexpr double kSpeedStep_m_s = 0.01;

const World& receiver_world() {
  static const World at_surface = near_surface(kReceiverDuration_s);
  return at_surface;
}

/// The radii of the ellipsoid differ from the sphere of the bench by parts in a thousand: only differences count.
void expect_against_nominal(const ParameterDeviations& deviations,
                            const std::function<FixSample(double)>& further) {
  const auto nominal = receiver_along(receiver_world(), {}),
             changed = receiver_along(receiver_world(), deviations.gps);
  ASSERT_EQ(nominal.size(), changed.size());
  int fixes = 0;
  for (std::size_t i = 0; i < nominal.size(); ++i) {
    if (!changed[i].fixed) continue;
    ++fixes;
    const FixSample expected = further(changed[i].time_s);
    const Eigen::Vector2d moved = changed[i].place_m - nominal[i].place_m;
    const Eigen::Vector2d quicker = changed[i].velocity_m_s - nominal[i].velocity_m_s;
    EXPECT_LT((moved - expected.place_m).norm(), 1.5 * kPlaceStep_m + 0.01 * expected.place_m.norm());
    EXPECT_LT((quicker - expected.velocity_m_s).norm(), 2 * kSpeedStep_m_s) << changed[i].time_s;
  }
  EXPECT_GT(fixes, 20);
}

TEST(Receiver, NominallyTellsWhereTheOriginIs) {
  for (const FixSample& fix : receiver_along(receiver_world(), {})) {
    if (!fix.fixed) continue;
    const Snapshot s = receiver_world().at(fix.time_s);
    EXPECT_LT((fix.place_m - s.position_m.head<2>()).norm(), kPlaceStep_m + 0.01 * s.position_m.norm());
    EXPECT_LT((fix.velocity_m_s - s.ground_velocity_m_s().head<2>()).norm(), 2 * kSpeedStep_m_s);
    EXPECT_NEAR(fix.time_s, std::round(fix.time_s), 1e-6);
  }
}

TEST(Receiver, LeverArmMovesAndSwingsWithTheBody) {
  expect_against_nominal(with("gps_lever_arm", {{"x_m", 0.4}, {"y_m", -0.2}}), [](double time_s) {
    const Snapshot s = receiver_world().at(time_s);
    const Vector3 arm(0.4, -0.2, 0);
    FixSample further;
    further.place_m = (s.world_from_body * arm).head<2>();
    further.velocity_m_s = (s.world_from_body * s.rate_rad_s.cross(arm)).head<2>();
    return further;
  });
}

TEST(Receiver, LatencyTellsOfThePast) {
  expect_against_nominal(with("gps_latency", {{"tau_s", 1.3}}), [](double time_s) {
    const Snapshot s = receiver_world().at(time_s), past = receiver_world().at(time_s - 1.3);
    FixSample further;
    further.place_m = (past.position_m - s.position_m).head<2>();
    further.velocity_m_s = (past.ground_velocity_m_s() - s.ground_velocity_m_s()).head<2>();
    return further;
  });
}

TEST(Receiver, MultipathTurnsTwiceAsFastAsTheHull) {
  expect_against_nominal(with("gps_multipath", {{"north_m", 2}}), [](double time_s) {
    const double twice = 2 * receiver_world().at(time_s).heading_rad();
    FixSample further;
    further.place_m = 2 * Eigen::Vector2d(std::cos(twice), std::sin(twice));
    return further;
  });
}

TEST(Receiver, FindsItsFirstFixTwoToTenSecondsAfterPower) {
  double earliest = 100, latest = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Fitting fitting = exact();
    fitting.seed = seed;
    const auto fixes = receiver_along(receiver_world(), {}, fitting);
    const auto first = std::find_if(fixes.begin(), fixes.end(), [](const FixSample& fix) { return fix.fixed; });
    ASSERT_NE(first, fixes.end());
    earliest = std::min(earliest, first->time_s);
    latest = std::max(latest, first->time_s);
  }
  EXPECT_GE(earliest, 2);
  EXPECT_LE(earliest, 5);
  EXPECT_GE(latest, 7);
  EXPECT_LE(latest, 10 + 1e-6);
}

TEST(Receiver, SeesNothingBelow) {
  const World deep = swung(15);
  for (const FixSample& fix : receiver_along(deep, {})) EXPECT_FALSE(fix.fixed);
}

}  // namespace
}  // namespace navcal::reference::testing
