// SPDX-License-Identifier: Apache-2.0
// Beams of Doppler logs: what is expected is calculated here from the directions of the beams.
#include "instruments/janus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/angles.h"
#include "instruments/error_velocity.h"

namespace navcal::instruments {
namespace {

constexpr double kDegrees_rad = base::kRadiansPerDegree;

/// Azimuth of the beams from beam 3, seen from above, of a convex head that looks down: to port, starboard,
/// forward and aft. A head that looks up is turned about its forward axis: 1 and 2 change sides.
Vector3 beam_in_body(int beam, const JanusHead& head) {
  double azimuth_deg = std::array<double, 4>{-90, 90, 0, 180}.at(static_cast<std::size_t>(beam));
  if (!head.is_convex) azimuth_deg += 180;
  if (head.looks_up) azimuth_deg = -azimuth_deg;
  const double azimuth_rad = azimuth_deg * kDegrees_rad + head.alignment_rad;
  const double aside = std::sin(head.beam_angle_rad);
  return {aside * std::cos(azimuth_rad), aside * std::sin(azimuth_rad),
          (head.looks_up ? -1 : 1) * std::cos(head.beam_angle_rad)};
}

double scalar_product(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Beams of a bottom, or water, that moves so relative to the head: positive towards it.
BeamValues beams_of(const Vector3& relative_m_s, const JanusHead& head) {
  BeamValues beams;
  for (int i = 0; i < 4; ++i)
    beams.at(static_cast<std::size_t>(i)) = -scalar_product(relative_m_s, beam_in_body(i, head));
  return beams;
}

std::vector<JanusHead> heads() {
  std::vector<JanusHead> all;
  for (const double angle_deg : {15.0, 20.0, 30.0}) {
    for (const bool convex : {true, false}) {
      for (const bool up : {true, false}) {
        for (const double alignment_deg : {0.0, 45.0, -30.0})
          all.push_back({angle_deg * kDegrees_rad, convex, up, alignment_deg * kDegrees_rad});
      }
    }
  }
  return all;
}

void expect_near(const Vector3& a, const Vector3& b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << i;
}

TEST(Janus, TheVelocityOfTheBottomComesBackFromItsBeams) {
  const Vector3 relative_m_s{-1.5, 0.3, 0.2};
  for (const JanusHead& head : heads()) {
    const BeamValues beams = beams_of(relative_m_s, head);
    const auto found = velocity_of_beams(beams, head);
    ASSERT_TRUE(found);
    expect_near(body_of_instrument(found->velocity_m_s, head), relative_m_s);
    EXPECT_NEAR(found->error_m_s.value(), 0, 1e-12);
  }
}

TEST(Janus, AnyThreeBeamsGiveTheSame) {
  const Vector3 relative_m_s{-0.7, -0.4, 0.1};
  for (const JanusHead& head : heads()) {
    for (std::size_t missing = 0; missing < 4; ++missing) {
      BeamValues beams = beams_of(relative_m_s, head);
      beams.at(missing).reset();
      const auto found = velocity_of_beams(beams, head);
      ASSERT_TRUE(found);
      expect_near(body_of_instrument(found->velocity_m_s, head), relative_m_s);
      EXPECT_FALSE(found->error_m_s) << "three beams do not contradict each other";
      beams.at((missing + 1) % 4).reset();
      EXPECT_FALSE(velocity_of_beams(beams, head)) << "two beams are too few";
    }
  }
}

TEST(Janus, ErrorVelocityHasTheVarianceOfTheHorizontalComponents) {
  const JanusHead head{30 * kDegrees_rad, true, false, 0};
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  double x2 = 0, y2 = 0, z2 = 0, e2 = 0;
  constexpr int kPings = 20000;
  for (int i = 0; i < kPings; ++i) {
    const auto found = velocity_of_beams({noise(random), noise(random), noise(random), noise(random)}, head);
    x2 += found->velocity_m_s[0] * found->velocity_m_s[0] / kPings;
    y2 += found->velocity_m_s[1] * found->velocity_m_s[1] / kPings;
    z2 += found->velocity_m_s[2] * found->velocity_m_s[2] / kPings;
    e2 += *found->error_m_s * *found->error_m_s / kPings;
  }
  EXPECT_NEAR(e2 / x2, 1, 0.06);
  EXPECT_NEAR(e2 / y2, 1, 0.06);
  EXPECT_LT(z2, x2);
}

TEST(Janus, AltitudeIsTheSameHoweverTheVehicleIsTilted) {
  constexpr double kHeight_m = 12;
  for (const JanusHead& head : heads()) {
    for (const auto& [pitch_deg, roll_deg] : {std::pair(0.0, 0.0), {-25.0, 0.0}, {10.0, 15.0}, {0.0, -20.0}}) {
      const double pitch = pitch_deg * kDegrees_rad, roll = roll_deg * kDegrees_rad;
      const Vector3 down{-std::sin(pitch), std::cos(pitch) * std::sin(roll), std::cos(pitch) * std::cos(roll)};
      BeamValues ranges;
      for (int i = 0; i < 4; ++i) {
        ranges.at(static_cast<std::size_t>(i)) =
            kHeight_m / scalar_product(beam_in_body(i, head), down) * std::cos(head.beam_angle_rad);
      }
      const auto altitude_m = altitude_of_beams(ranges, head, pitch, roll);
      EXPECT_EQ(altitude_m.has_value(), !head.looks_up) << "a head that looks up sees the surface";
      if (!altitude_m) continue;
      EXPECT_NEAR(*altitude_m, kHeight_m, 1e-9);
      ranges[1].reset();
      EXPECT_NEAR(altitude_of_beams(ranges, head, pitch, roll).value(), kHeight_m, 1e-9);
    }
  }
  EXPECT_FALSE(altitude_of_beams({}, JanusHead{30 * kDegrees_rad, true, false, 0}, 0, 0));
  EXPECT_FALSE(altitude_of_beams({1.0, 1.0, 1.0, 1.0}, JanusHead{30 * kDegrees_rad, true, false, 0}, 1.5, 0))
      << "a beam above the horizontal";
}

TEST(Janus, LevelVelocitiesAreTurnedBackIntoTheBody) {
  // Nose 30 degrees up and straight up through the water: that is forward and up in the body.
  expect_near(body_of_level({0, 0, -1}, 30 * kDegrees_rad, 0), {0.5, 0, -std::sqrt(3) / 2});
  // Rolled 90 degrees to starboard, down is where starboard points.
  expect_near(body_of_level({0, 0, 1}, 0, 90 * kDegrees_rad), {0, 1, 0});
}

TEST(Janus, PendulumPitchOfARolledInstrument) {
  EXPECT_NEAR(euler_pitch_rad(10 * kDegrees_rad, 0), 10 * kDegrees_rad, 1e-12);
  const double pitch = 10 * kDegrees_rad, roll = 25 * kDegrees_rad;
  // Gravity in the instrument's axes: what the pendulum's plane shows.
  const double shown = std::atan2(std::sin(pitch), std::cos(pitch) * std::cos(roll));
  EXPECT_NEAR(euler_pitch_rad(shown, roll), pitch, 1e-12);
}

TEST(ErrorVelocity, StatesNothingBeforeItKnowsAndFollowsTheNoise) {
  ErrorVelocity history;
  std::mt19937_64 random(2);
  std::normal_distribution<double> quiet(0, 0.005), loud(0, 0.05);
  for (int i = 0; i < 7; ++i) {
    history.take(quiet(random));
    EXPECT_FALSE(history.std_m_s());
  }
  for (int i = 0; i < 200; ++i) history.take(quiet(random));
  EXPECT_NEAR(history.std_m_s().value(), 0.005, 0.0035);
  history.take(0.3);
  EXPECT_GE(history.std_m_s().value(), 0.3) << "the newest one counts by itself";
  for (int i = 0; i < 300; ++i) history.take(loud(random));
  EXPECT_GT(history.std_m_s().value(), 0.03);
  ErrorVelocity silent;
  for (int i = 0; i < 50; ++i) silent.take(0);
  EXPECT_GT(silent.std_m_s().value(), 0) << "no instrument is without error";
}

}  // namespace
}  // namespace navcal::instruments
