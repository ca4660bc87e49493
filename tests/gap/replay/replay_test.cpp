// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/replay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/angles.h"
#include "gap/inference/biases.h"
#include "gap/inference/library.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap {
namespace {

using test::simulated_mission;

double rms(const Innovations& innovations, Channel channel, Eigen::Index from = 300) {
  double square = 0;
  int count = 0;
  for (Eigen::Index i = from; i < innovations.grid.rows(); ++i) {
    const double value = innovations.grid(i, channel);
    if (!std::isfinite(value)) continue;
    square += value * value;
    ++count;
  }
  return std::sqrt(square / count);
}

Innovations replayed(const Mission& mission, const char* effect = nullptr, double value = 0) {
  const Replay replay(mission, {});
  const Library library({});
  Eigen::VectorXd values = with_biases_found(replay, library, 1);
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (effect != nullptr && library[e].name == effect) values[library.first(e)] = value;
  }
  return replay.run(library.model(values));
}

TEST(Replay, ANominalMissionLeavesTheInstrumentsNoise) {
  const Innovations left = replayed(simulated_mission("identification", "", 150, 3));
  EXPECT_NEAR(rms(left, field_x), 0.15, 0.05);
  EXPECT_NEAR(rms(left, tilt_pitch), 0.1 * base::kRadiansPerDegree, 0.05 * base::kRadiansPerDegree);
  EXPECT_LT(rms(left, gyro_yaw_a), 0.3 * base::kRadiansPerDegree);
  EXPECT_LT(rms(left, force_y), 0.03);
  EXPECT_LT(rms(left, depth), 0.03);
}

TEST(Replay, AnEffectLeavesItsMarkUntilItIsInTheModel) {
  const Mission mission = simulated_mission("identification", "[hard_iron]\nx_uT = 3\n", 150, 3);
  const double before = rms(replayed(mission), field_x);
  const double after = rms(replayed(mission, "hard_iron", 3), field_x);
  EXPECT_GT(before, 0.5);
  EXPECT_LT(after, 0.3);
}

// Without any effect the compass's fluid was felt at its words only: whatever was tried beside it got that
// difference for a signature, which on a straight course was all there was of an antenna's lever arm.
TEST(Replay, AnEffectOfHardlyAnythingChangesHardlyAnything) {
  const Mission mission = simulated_mission("identification", "", 60, 4);
  const Replay replay(mission, {});
  const Library library({});
  const Innovations without = replay.run({});
  for (std::size_t e = 0; e < library.size(); ++e) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
    const Eigen::Index j = library.first(e);
    values[j] = 1e-9 * library.unknowns()[static_cast<std::size_t>(j)].typical;
    const Innovations with = replay.run(library.model(values));
    for (Eigen::Index i = 0; i < with.grid.size(); ++i) {
      if (std::isfinite(with.grid(i))) {
        ASSERT_NEAR(with.grid(i), without.grid(i), 1e-6) << library[e].name;
      }
    }
  }
}

TEST(Replay, ASecondRunGivesTheSameToTheBit) {
  const Mission mission = simulated_mission("identification", "", 60, 4);
  const Replay replay(mission, {});
  const Innovations a = replay.run({}), b = replay.run({});
  for (Eigen::Index i = 0; i < a.grid.size(); ++i) {
    EXPECT_TRUE(a.grid(i) == b.grid(i) || (std::isnan(a.grid(i)) && std::isnan(b.grid(i))));
  }
}

TEST(Replay, GapsAndRestartsAreGoneOver) {
  Mission mission = simulated_mission("identification", "", 150, 5);
  std::erase_if(mission.card, [](const CardReading& r) { return r.time_s > 60 && r.time_s < 61; });
  std::erase_if(mission.card, [](const CardReading& r) { return r.time_s > 90 && r.time_s < 100; });
  std::erase_if(mission.compass, [](const CompassReading& r) { return r.time_s > 70 && r.time_s < 80; });
  std::erase_if(mission.motor, [](const MotorReading& r) { return r.time_s > 110 && r.time_s < 112; });
  const Innovations left = replayed(mission);
  for (Eigen::Index j = 0; j < kChannels; ++j) {
    for (Eigen::Index i = 0; i < left.grid.rows(); ++i) {
      EXPECT_TRUE(std::isnan(left.grid(i, j)) || std::abs(left.grid(i, j)) < 100);
    }
  }
  EXPECT_TRUE(std::isnan(left.grid(955, gyro_yaw_a)));
}

// Readings correct the estimate: it jumped where a delay came to be as long as the time between two of them.
TEST(Replay, ALatencyAsLongAsAFrameIsNothingApart) {
  const Mission mission = simulated_mission("identification", "[gyro_scale]\nscale_by = 0.05\n", 100, 6);
  const auto moved = [&](double from_s, double to_s) {
    const Innovations a = replayed(mission, "imu_latency", from_s), b = replayed(mission, "imu_latency", to_s);
    double square = 0;
    for (Eigen::Index i = 300; i < a.grid.rows(); ++i) {
      const double apart = a.grid(i, gyro_pitch) - b.grid(i, gyro_pitch);
      if (std::isfinite(apart)) square += apart * apart;
    }
    return std::sqrt(square);
  };
  const double frame_s = mission.card[100].time_s - mission.card[99].time_s;
  const double across = moved(frame_s - 0.0005, frame_s + 0.0005);
  EXPECT_LT(across, 2 * moved(frame_s - 0.004, frame_s - 0.003));
  EXPECT_LT(across, 2 * moved(frame_s + 0.003, frame_s + 0.004));
}

// Single corrections were part of a way longer than a frame: beyond it their noise was much of what a little more
// latency changed, and a search stopped there.
TEST(Replay, ALatencyBeyondAFrameChangesWhatOneBelowDoes) {
  const Mission mission = simulated_mission("identification", "", 100, 6);
  const double frame_s = mission.card[100].time_s - mission.card[99].time_s;
  const auto change = [&](double from_s, double to_s) -> Eigen::VectorXd {
    const Eigen::VectorXd apart = replayed(mission, "imu_latency", to_s).grid.col(depth) -
                                  replayed(mission, "imu_latency", from_s).grid.col(depth);
    return apart.tail(apart.size() - 300).unaryExpr([](double x) { return std::isfinite(x) ? x : 0; });
  };
  const Eigen::VectorXd below = change(frame_s - 0.006, frame_s - 0.001);
  const Eigen::VectorXd above = change(frame_s + 0.001, frame_s + 0.006);
  EXPECT_GT(below.dot(above), 0.97 * below.norm() * above.norm());
}

TEST(Replay, AMissionWithoutFixesHasTheOtherChannels) {
  Mission mission = simulated_mission("identification", "", 60, 6);
  mission.fixes.clear();
  const Innovations left = replayed(mission);
  EXPECT_EQ(left.fixes.rows(), 0);
  EXPECT_TRUE(std::isfinite(left.grid(400, field_x)));
}

}  // namespace
}  // namespace navcal::gap
