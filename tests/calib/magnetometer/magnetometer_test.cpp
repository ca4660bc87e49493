// SPDX-License-Identifier: Apache-2.0
#include "calib/magnetometer/magnetometer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "calib/suite/report.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib::test {
namespace {

/// Turns at half a radian per second, with the roll and pitch of a hull in waves.
std::vector<FieldReading> turning(int readings, int first, const Eigen::Vector3d& hard_uT, Random& random) {
  std::vector<Attitude> motion;
  for (int i = first; i < first + readings; ++i) {
    motion.push_back({0.05 * i, 0.1 * std::sin(0.21 * i), 0.08 * std::sin(0.13 * i)});
  }
  Iron iron;
  iron.hard_uT = hard_uT;
  return field_on(motion, iron, random);
}

void feed(Magnetometer& magnetometer, const std::vector<FieldReading>& readings) {
  for (const auto& r : readings) magnetometer.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
}

std::string saved(Magnetometer& magnetometer) {
  Archive archive;
  archive(magnetometer);
  return archive.bytes();
}

const Eigen::Vector3d kBefore(3, -2, 1), kAfter(1.5, -4, 3);

TEST(Magnetometer, AStepOfTheFieldIsFoundAndTheNewFieldLearnt) {
  Random random(1);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  feed(magnetometer, turning(600, 0, kBefore, random));
  ASSERT_EQ(magnetometer.field_steps(), 0u);
  ASSERT_TRUE(magnetometer.judgement().accepted) << magnetometer.judgement().reason;
  feed(magnetometer, turning(600, 600, kAfter, random));
  ASSERT_EQ(magnetometer.field_steps(), 1u);
  EXPECT_NEAR(static_cast<double>(magnetometer.last_step()->onset_sample), 601, 5);
  EXPECT_LT(magnetometer.last_step()->found_sample, 640u);
  EXPECT_FALSE(magnetometer.last_step()->returned);
  magnetometer.settle();
  EXPECT_LT((magnetometer.ellipse().estimate()->correction.offset_uT - kAfter).head<2>().norm(), 0.2);
}

TEST(Magnetometer, WhenTheOldFieldReturnsItsSummaryGoesOn) {
  Random random(2);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  feed(magnetometer, turning(600, 0, kBefore, random));
  feed(magnetometer, turning(400, 600, kAfter, random));
  feed(magnetometer, turning(200, 1000, kBefore, random));
  EXPECT_EQ(magnetometer.field_steps(), 2u);
  ASSERT_TRUE(magnetometer.last_step());
  EXPECT_TRUE(magnetometer.last_step()->returned);
  EXPECT_GT(magnetometer.ellipse().estimate()->samples, 700u);
  EXPECT_LT((magnetometer.ellipse().estimate()->correction.offset_uT - kBefore).head<2>().norm(), 0.2);
}

/// A hull that tumbles: every attitude within some seconds.
std::vector<FieldReading> tumbling(int readings, int first, const Eigen::Vector3d& hard_uT, Random& random) {
  std::vector<Attitude> motion;
  for (int i = first; i < first + readings; ++i)
    motion.push_back({0.11 * i + std::sin(0.031 * i), 1.2 * std::sin(0.083 * i), std::sin(0.057 * i)});
  Iron iron;
  iron.hard_uT = hard_uT;
  return field_on(motion, iron, random);
}

TEST(Magnetometer, AStepLargerThanTheFieldIsFoundWithItsSizeAndItsReturn) {
  for (const Eigen::Vector3d& size_uT : {Eigen::Vector3d(0, 0, 58), Eigen::Vector3d(35, 29, 36)}) {
    for (std::uint64_t seed = 30; seed < 34; ++seed) {
      Random random(seed);
      Magnetometer magnetometer{Magnetometer::Parameters{}};
      feed(magnetometer, tumbling(300, 0, kBefore, random));
      // The magnet is on its way for half a second.
      for (int i = 0; i < 5; ++i)
        feed(magnetometer, tumbling(1, 300 + i, kBefore + size_uT * (i + 0.5) / 5, random));
      feed(magnetometer, tumbling(600, 305, kBefore + size_uT, random));
      feed(magnetometer, tumbling(600, 905, kBefore, random));
      magnetometer.settle();
      const auto& steps = magnetometer.history().steps();
      ASSERT_EQ(steps.size(), 2U) << size_uT.transpose() << " seed " << seed;
      EXPECT_NEAR(static_cast<double>(steps[0].onset_sample), 304, 5);
      EXPECT_LT(steps[0].found_sample, 350U);
      EXPECT_LT((steps[0].size_uT - size_uT).norm(), 1.5) << steps[0].size_uT.transpose();
      EXPECT_LT((steps[1].size_uT + size_uT).norm(), 1.5) << steps[1].size_uT.transpose();
      EXPECT_TRUE(steps[1].returned);
      EXPECT_LT((magnetometer.estimate()->correction.offset_uT - kBefore).norm(), 1);
    }
  }
}

TEST(Magnetometer, AMagnetThatComesWhileTheHullRestsIsFound) {
  for (std::uint64_t seed = 40; seed < 44; ++seed) {
    Random random(seed);
    Magnetometer magnetometer{Magnetometer::Parameters{}};
    int count = 0;
    const Eigen::Vector3d size_uT(8, 7, 9);
    const auto rest = [&](int readings, const Eigen::Vector3d& hard_uT) {
      Iron iron;
      iron.hard_uT = hard_uT;
      for (const auto& r : field_on(std::vector<Attitude>(static_cast<std::size_t>(readings)), iron, random)) {
        TurnStep turn;
        turn.time_s = 0.1 * ++count;
        turn.begins_segment = count == 1;
        turn.duration_s = 0.1;
        turn.measured_angle_rad = 0.001;  // by the gyro's bias
        magnetometer.update(r.field_body_uT, r.roll_rad, r.pitch_rad, turn);
      }
    };
    rest(300, kBefore);
    rest(50, kBefore + size_uT);
    feed(magnetometer, tumbling(600, 0, kBefore + size_uT, random));
    magnetometer.settle();
    const auto& steps = magnetometer.history().steps();
    ASSERT_EQ(steps.size(), 1U) << seed;
    EXPECT_NEAR(static_cast<double>(steps[0].onset_sample), 301, 2);
    EXPECT_LT(steps[0].found_sample, 331U);
    EXPECT_LT((steps[0].size_uT - size_uT).norm(), 1.5) << steps[0].size_uT.transpose();
    EXPECT_LT((magnetometer.estimate()->correction.offset_uT - kBefore - size_uT).norm(), 1);
  }
}

TEST(Magnetometer, OutliersAreLeftOutAndAreNoStep) {
  Random random(3);
  std::uniform_real_distribution<double> anywhere(-60, 60);
  Magnetometer clean{Magnetometer::Parameters{}}, dirty{Magnetometer::Parameters{}};
  const auto readings = turning(1000, 0, kBefore, random);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    clean.update(readings[i].field_body_uT, readings[i].roll_rad, readings[i].pitch_rad);
    dirty.update(readings[i].field_body_uT, readings[i].roll_rad, readings[i].pitch_rad);
    if (i > 200 && i % 25 == 0) dirty.update({anywhere(random), anywhere(random), anywhere(random)}, 0, 0);
  }
  EXPECT_EQ(dirty.field_steps(), 0u);
  EXPECT_GE(dirty.left_out(), 25u);
  clean.settle();
  dirty.settle();
  EXPECT_LT((clean.ellipse().fit()->shape.centre_uT - dirty.ellipse().fit()->shape.centre_uT).norm(), 0.05);
}

TEST(Magnetometer, NoStepWhereThereIsNone) {
  for (std::uint64_t seed = 10; seed < 15; ++seed) {
    Random random(seed);
    Magnetometer magnetometer{Magnetometer::Parameters{}};
    feed(magnetometer, turning(1500, 0, kBefore, random));
    EXPECT_EQ(magnetometer.field_steps(), 0u) << seed;
    EXPECT_LT(magnetometer.left_out(), 5u) << seed;
  }
}

/// Spirals down and up: a hull that is hardly level, whose vertical offset the ellipse takes for a change of
/// field.
TEST(Magnetometer, ADiveIsNoStep) {
  Random random(16);
  std::vector<Attitude> motion;
  for (int i = 0; i < 600; ++i) motion.push_back({0.05 * i, 0.02 * std::sin(0.21 * i), 0.02 * std::sin(0.13 * i)});
  for (int i = 600; i < 2400; ++i) {
    const double pitch_rad = (i / 300) % 2 == 0 ? -0.45 : 0.4;
    motion.push_back({0.05 * i, 0.05 * std::sin(0.21 * i), pitch_rad + 0.02 * std::sin(0.13 * i)});
  }
  Iron iron;
  iron.hard_uT = {3, -2, 12};
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  feed(magnetometer, field_on(motion, iron, random));
  EXPECT_EQ(magnetometer.field_steps(), 0u);
  EXPECT_LT(magnetometer.left_out(), 20u);
  EXPECT_EQ(magnetometer.method(), Magnetometer::Method::ellipsoid) << magnetometer.judgement().reason;
  EXPECT_LT((magnetometer.estimate()->correction.offset_uT - iron.hard_uT).norm(), 1.0);
}

/// Level turns for a minute, then roll and pitch, with soft iron and a vertical offset.
TEST(Magnetometer, TheFirstTiltIsNoStep) {
  for (std::uint64_t seed = 20; seed < 24; ++seed) {
    Random random(seed);
    std::vector<Attitude> motion;
    for (int i = 0; i < 1500; ++i) {
      const double sway = i < 600 ? 0 : std::min(1.0, (i - 600) / 100.0);
      motion.push_back({0.025 * i, 0.35 * sway * std::sin(0.031 * i), 0.3 * sway * std::sin(0.019 * i)});
    }
    Iron iron = some_iron();
    iron.hard_uT = {3, -2, 15};
    Magnetometer magnetometer{Magnetometer::Parameters{}};
    feed(magnetometer, field_on(motion, iron, random));
    EXPECT_EQ(magnetometer.field_steps(), 0u) << seed;
    EXPECT_LT(magnetometer.left_out(), 15u) << seed;
  }
}

/// Four uT in ten minutes.
TEST(Magnetometer, ASlowDriftIsNoStep) {
  Random random(17);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  auto readings = turning(6000, 0, kBefore, random);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i].field_body_uT.y() += 4 * static_cast<double>(i) / static_cast<double>(readings.size());
  feed(magnetometer, readings);
  EXPECT_EQ(magnetometer.field_steps(), 0u);
}

/// The same iron where the Earth's field is `share` of its size.
void feed_at(Magnetometer& magnetometer, double begin_s, double share, const std::vector<FieldReading>& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    Magnetometer::Reading reading;
    reading.field_body_uT = kBefore + share * (readings[i].field_body_uT - kBefore);
    reading.roll_rad = readings[i].roll_rad;
    reading.pitch_rad = readings[i].pitch_rad;
    reading.time_s = begin_s + 0.1 * static_cast<double>(i);
    magnetometer.update(reading);
  }
}

TEST(Magnetometer, AnotherPlaceIsNoStepAndWhatWasAcceptedStands) {
  Random random(11);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  feed_at(magnetometer, 0, 1, turning(600, 0, kBefore, random));
  ASSERT_TRUE(magnetometer.judgement().accepted) << magnetometer.judgement().reason;
  feed_at(magnetometer, 3700, 0.6, turning(60, 600, kBefore, random));
  EXPECT_EQ(magnetometer.field_steps(), 0U);
  EXPECT_EQ(magnetometer.moves(), 1U);
  EXPECT_TRUE(magnetometer.is_elsewhere());
  EXPECT_TRUE(magnetometer.judgement().accepted) << magnetometer.judgement().reason;
  EXPECT_LT((magnetometer.estimate()->correction.offset_uT - kBefore).head<2>().norm(), 0.2);
  // Other iron than before: what was accepted stands no longer.
  feed_at(magnetometer, 7400, 0.6, turning(40, 660, kBefore + Eigen::Vector3d(12, -9, 0), random));
  EXPECT_FALSE(magnetometer.judgement().accepted);
}

TEST(FieldStep, AnotherPlaceIsToldInWordsOfItsOwn) {
  FieldStep move;
  move.is_place = true;
  EXPECT_NE(words_of(move).find("another place"), std::string::npos);
  move.returned = true;
  EXPECT_NE(words_of(move).find("the place before"), std::string::npos);
}

TEST(Magnetometer, AnotherRunAtTheSamePlaceGoesOn) {
  Random random(12);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  for (int run = 0; run < 5; ++run)
    feed_at(magnetometer, 3700.0 * run, 1, turning(200, 200 * run, kBefore, random));
  EXPECT_EQ(magnetometer.field_steps(), 0U);
  EXPECT_EQ(magnetometer.moves(), 0U);
  EXPECT_TRUE(magnetometer.judgement().accepted) << magnetometer.judgement().reason;
}

TEST(Magnetometer, AFixAtAnotherPlaceBeginsAnew) {
  Random random(13);
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  magnetometer.set_known_field(KnownField{48, 1.16});
  feed_at(magnetometer, 0, 1, turning(600, 0, kBefore, random));
  magnetometer.set_known_field(KnownField{48.2, 1.16});
  EXPECT_EQ(magnetometer.moves(), 0U);
  magnetometer.set_known_field(KnownField{30, 1.16});
  EXPECT_EQ(magnetometer.moves(), 1U);
  EXPECT_TRUE(magnetometer.judgement().accepted) << magnetometer.judgement().reason;
  const std::string before = saved(magnetometer);
  Magnetometer again{Magnetometer::Parameters{}};
  Archive archive(before);
  archive(again);
  EXPECT_TRUE(archive.ok());
  EXPECT_EQ(saved(again), before);
  EXPECT_TRUE(again.is_elsewhere());
  EXPECT_EQ(again.estimate()->correction.offset_uT, magnetometer.estimate()->correction.offset_uT);
}

TEST(Magnetometer, RestoredGoesOnBitForBit) {
  Random random(4);
  const auto first = turning(500, 0, kBefore, random), second = turning(300, 500, kAfter, random);
  Magnetometer one{Magnetometer::Parameters{}}, other{Magnetometer::Parameters{}};
  feed(one, first);
  feed(one, {second.begin(), second.begin() + 100});
  ASSERT_EQ(one.field_steps(), 1u);
  const std::string bytes = saved(one);
  Archive archive{std::string_view(bytes)};
  archive(other);
  ASSERT_TRUE(archive.ok() && archive.at_end());
  feed(one, {second.begin() + 100, second.end()});
  feed(other, {second.begin() + 100, second.end()});
  EXPECT_EQ(saved(one), saved(other));
}

TEST(Magnetometer, BadReadingsAreCountedAndChangeNoEstimate) {
  Random random(5);
  Magnetometer clean{Magnetometer::Parameters{}}, dirty{Magnetometer::Parameters{}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& r : turning(300, 0, kBefore, random)) {
    clean.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
    dirty.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
    dirty.update({nan, 0, 0}, 0, 0);
    dirty.update({1e9, 0, 0}, 0, 0);
  }
  EXPECT_EQ(dirty.left_out(), 600u + clean.left_out());
  EXPECT_EQ(clean.estimate()->correction.offset_uT, dirty.estimate()->correction.offset_uT);
}

TEST(Magnetometer, WithoutAnythingThereIsNoEstimate) {
  const Magnetometer magnetometer{Magnetometer::Parameters{}};
  EXPECT_FALSE(magnetometer.estimate());
  EXPECT_EQ(magnetometer.method(), Magnetometer::Method::none);
  EXPECT_FALSE(magnetometer.judgement().accepted);
}

}  // namespace
}  // namespace navcal::calib::test
