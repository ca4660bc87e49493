// SPDX-License-Identifier: Apache-2.0
// Measurements of a DVL that disagree with those before them, and the set that they show.
#include "nav/held_velocity.h"

#include <gtest/gtest.h>

namespace navcal::nav {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::int64_t kVelocityPing_ns = 200'000'000;

/// Takes a measurement with 0.01 m/s noise at that ping.
bool taken(HeldVelocity& held, int ping, double ahead_m_s, VelocityFrame frame = VelocityFrame::body) {
  return held.take(ping * kVelocityPing_ns, Vector3d(ahead_m_s, 0, 0), frame, 0.01, {}).has_value();
}

TEST(HeldVelocity, IsUnknownBeforeTheFirstMeasurementAndAfterAPause) {
  HeldVelocity held;
  EXPECT_FALSE(held.current(0));
  EXPECT_TRUE(taken(held, 0, 1));
  EXPECT_TRUE(held.current(3'000'000'000));
  EXPECT_FALSE(held.current(3'000'000'001));
}

TEST(HeldVelocity, OneOutlierIsPassedOverAndCounted) {
  HeldVelocity held;
  EXPECT_TRUE(taken(held, 0, 1));
  EXPECT_FALSE(taken(held, 1, -2));
  EXPECT_TRUE(taken(held, 2, 1.1));
  EXPECT_EQ(held.outliers(), 1U);
  EXPECT_EQ(held.velocity_m_s().x(), 1.1);
}

TEST(HeldVelocity, FiveThatAgreeBeginAnewFiveThatDoNotDont) {
  HeldVelocity held;
  EXPECT_TRUE(taken(held, 0, 1));
  for (int ping = 1; ping < 5; ++ping) EXPECT_FALSE(taken(held, ping, -2 - 0.1 * ping));
  EXPECT_TRUE(taken(held, 5, -2.5));
  EXPECT_EQ(held.velocity_m_s().x(), -2.5);
  for (int ping = 6; ping < 12; ++ping) EXPECT_FALSE(taken(held, ping, 2.0 * ping));
  EXPECT_EQ(held.velocity_m_s().x(), -2.5);
}

TEST(HeldVelocity, TheLongerAgoTheMoreItMayHaveChanged) {
  HeldVelocity held;
  EXPECT_TRUE(taken(held, 0, 1));
  EXPECT_FALSE(taken(held, 1, 2)) << "5 m/s2";
  EXPECT_TRUE(taken(held, 6, 2)) << "0.8 m/s2";
}

TEST(HeldVelocity, TheFirstIsComparedWithWhatOthersExpect) {
  const HeldVelocity::Expected expected{{1, 0, 0}, 0.1};
  HeldVelocity held;
  for (int ping = 0; ping < 4; ++ping)
    EXPECT_FALSE(held.take(ping, Vector3d(-1, 0, 0), VelocityFrame::body, 0.01, expected));
  EXPECT_TRUE(held.take(4, Vector3d(-1, 0, 0), VelocityFrame::body, 0.01, expected)) << "it insists";
  HeldVelocity other;
  EXPECT_TRUE(other.take(0, Vector3d(1.3, 0, 4), VelocityFrame::body, 0.01, expected)) << "z is not compared";
}

TEST(HeldVelocity, AnotherFrameBeginsAnew) {
  HeldVelocity held;
  EXPECT_TRUE(taken(held, 0, 1));
  EXPECT_TRUE(taken(held, 1, -1, VelocityFrame::earth));
  EXPECT_EQ(held.outliers(), 0U);
}

TEST(HeldVelocity, NoiseGrowsWithTheInterval) {
  HeldVelocity held;
  taken(held, 0, 1);
  taken(held, 1, 1);
  EXPECT_NEAR(held.noise_m2_per_s(), 0.01 * 0.01 * 0.2, 1e-15);
}

TEST(SetWindow, TellsTheMeanOfASecond) {
  SetWindow window;
  for (int ping = 0; ping < 5; ++ping)
    EXPECT_FALSE(
        window.take(ping * kVelocityPing_ns, Vector2d(1.1 + 0.01 * (ping % 2), 0), Vector2d(1, 0.2), 0.1));
  const auto set = window.take(5 * kVelocityPing_ns, Vector2d(1.11, 0), Vector2d(1, 0.2), 0.1);
  ASSERT_TRUE(set);
  EXPECT_NEAR(set->set_m_s.x(), 0.105, 1e-12);
  EXPECT_NEAR(set->set_m_s.y(), -0.2, 1e-12);
  EXPECT_NEAR(set->std_m_s, std::hypot(0.1 / std::sqrt(6), 0.05, 2 * 0.01), 1e-12);
  EXPECT_FALSE(window.take(6 * kVelocityPing_ns, Vector2d(1, 0), Vector2d(1, 0), 0.1)) << "a window of its own";
}

TEST(SetWindow, ATurnOrAChangeOfSpeedCountsForLess) {
  for (const Vector2d& end_m_s : {Vector2d(0.9, 0.4), Vector2d(0.6, 0)}) {
    SetWindow window;
    window.take(0, Vector2d(1, 0), Vector2d(1, 0), 0.01);
    const auto set = window.take(5 * kVelocityPing_ns, end_m_s, end_m_s, 0.01);
    ASSERT_TRUE(set);
    EXPECT_GT(set->std_m_s, 0.7);
  }
}

TEST(SetWindow, AGapBeginsAnew) {
  SetWindow window;
  EXPECT_FALSE(window.take(0, Vector2d(5, 0), Vector2d(0, 0), 0.01));
  EXPECT_FALSE(window.take(10 * kVelocityPing_ns, Vector2d(1, 0), Vector2d(1, 0), 0.01));
  const auto set = window.take(15 * kVelocityPing_ns, Vector2d(1, 0), Vector2d(1, 0), 0.01);
  ASSERT_TRUE(set);
  EXPECT_EQ(set->set_m_s, Vector2d::Zero());
}

}  // namespace
}  // namespace navcal::nav
