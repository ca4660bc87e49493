// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/suite.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/angles.h"
#include "tests/calib/suite/suite_drive.h"

namespace navcal::calib {
namespace {

using namespace test;

Report run(const std::string& path, const SuiteOptions& options, const Noise& noise = {}) {
  Suite suite(options, kCompassAndGyros);
  for (const Reading& reading : readings_along(path, thesis_deviation(), noise, 1)) suite.put(reading);
  suite.finish();
  return suite.report();
}

double worst_heading_error_deg(const DeviationCorrection& correction) {
  double worst = 0;
  for (int i = 0; i < 360; ++i) {
    const double measured = i * base::kRadiansPerDegree;
    const double truth = measured - deviation_rad(thesis_deviation(), measured);
    worst = std::max(worst, std::abs(std::remainder(correction(measured) - truth, 2 * std::numbers::pi)));
  }
  return worst / base::kRadiansPerDegree;
}

TEST(Suite, FindsGyrosAndDeviationTogetherWhereTheVehicleTurnsThroughTheCircle) {
  for (const std::string path : {"path2", "path5", "path6"}) {
    const Report report = run(path, thesis_options());
    const auto* gyro = report.find(Calibrator::gyro);
    const auto* compass = report.find(Calibrator::compass);
    ASSERT_TRUE(gyro != nullptr && compass != nullptr);
    EXPECT_TRUE(gyro->judgement.accepted) << path << ": " << gyro->judgement.reason;
    EXPECT_TRUE(compass->judgement.accepted) << path << ": " << compass->judgement.reason;
    ASSERT_TRUE(report.estimates.gyro && report.estimates.gyro_b && report.estimates.compass);
    EXPECT_NEAR(report.estimates.gyro->scale, kTrueScale, 5 * gyro->quantity("scale")->std) << path;
    EXPECT_NEAR(report.estimates.gyro->bias_rad_s, kTrueBias_rad_s, 5 * gyro->quantity("bias_rad_s")->std) << path;
    EXPECT_NEAR(report.estimates.gyro_b->scale, kGyroB.scale, 0.01) << path;
    EXPECT_LT(worst_heading_error_deg(*report.estimates.compass), 0.5) << path;
  }
}

TEST(Suite, TheAdaptiveIdentifierIsShownAndNeverComesIntoForce) {
  Suite suite(thesis_options(), kCompassAndGyros);
  const Calibrator adaptive = *calibrator_named("adaptive");
  EXPECT_TRUE(suite.report().find(adaptive)->estimate.empty());
  const auto turn = [&](int from, int to, double rate_rad_s) {
    double heading_rad = 0;
    for (int i = from; i < to; ++i) {
      const double now_rad_s = rate_rad_s * std::sin(0.05 * i);
      heading_rad += 0.1 * now_rad_s;
      RateReading rate;
      rate.time_s = 0.1 * i;
      rate.rate_rad_s.z() = (now_rad_s - 0.02) / 0.9;
      suite.put(rate);
      CompassReading compass;
      compass.time_s = 0.1 * i;
      compass.heading_rad = base::wrapped(heading_rad);
      compass.roll_rad = compass.pitch_rad = 0;
      suite.put(compass);
    }
  };
  turn(0, 3000, 0.5);
  const Report report = suite.report();
  ASSERT_NE(report.find(adaptive)->quantity("scale"), nullptr);
  EXPECT_NEAR(report.find(adaptive)->quantity("scale")->value, 0.9, 0.05);
  EXPECT_NEAR(report.find(adaptive)->quantity("bias_rad_s")->value, 0.02, 0.02);
  EXPECT_FALSE(report.find(adaptive)->judgement.accepted);
  EXPECT_NE(suite.accept(adaptive, true), "");
  // Euler's method runs away on a hull that spins: what is shown stays finite.
  turn(3000, 4000, 60);
  for (const Quantity& quantity : suite.report().find(adaptive)->estimate)
    EXPECT_TRUE(std::isfinite(quantity.value)) << quantity.name;
}

TEST(Suite, AVehicleWithoutASecondGyroFindsTheSameForTheFirst) {
  Suite both(thesis_options(), kCompassAndGyros), one(thesis_options(), kCompassAndGyros);
  for (Reading reading : readings_along("path2", thesis_deviation(), Noise{}, 1)) {
    both.put(reading);
    if (auto* rate = std::get_if<RateReading>(&reading)) rate->yaw_rate_b_rad_s.reset();
    one.put(reading);
  }
  both.finish();
  one.finish();
  const Report with = both.report(), without = one.report();
  ASSERT_TRUE(with.estimates.gyro && without.estimates.gyro);
  EXPECT_EQ(without.estimates.gyro->scale, with.estimates.gyro->scale);
  EXPECT_EQ(without.estimates.gyro->bias_rad_s, with.estimates.gyro->bias_rad_s);
  EXPECT_FALSE(without.estimates.gyro_b);
  EXPECT_FALSE(without.in_force.gyro_b);
  const std::string state = saved(one);
  Suite again = restored(state, thesis_options(), kCompassAndGyros);
  EXPECT_EQ(saved(again), state);
}

TEST(Suite, RefusesWhatAnArcCannotTellAndSaysWhichTurnIsMissing) {
  for (const std::string path : {"path3", "path4"}) {
    const Report report = run(path, thesis_options());
    for (const auto calibrator : {Calibrator::gyro, Calibrator::compass}) {
      const auto& judgement = report.find(calibrator)->judgement;
      EXPECT_FALSE(judgement.accepted) << path;
      EXPECT_NE(judgement.reason.find("of the circle were seen"), std::string::npos) << judgement.reason;
      EXPECT_NE(judgement.manoeuvre.find("turn through"), std::string::npos) << judgement.manoeuvre;
      EXPECT_EQ(report.find(calibrator)->verdict, Verdict::refused);
    }
    EXPECT_EQ(report.name.number, 0U) << path << ": nothing may have come into force";
  }
}

TEST(Suite, RefusesWhereTheVehicleDoesNotTurn) {
  Suite suite(thesis_options(), kCompassAndGyros);
  Random random(3);
  std::normal_distribution<double> noise(0, 0.004);
  for (int i = 0; i < 600; ++i) {
    suite.put(RateReading{i * 0.1, {0, 0, 0.1 + noise(random)}, noise(random), {}});
    suite.put(CompassReading{i * 0.1, 1.0 + noise(random), 0.0, 0.0, {}, false});
  }
  suite.finish();
  const Report report = suite.report();
  EXPECT_EQ(report.find(Calibrator::gyro)->judgement.reason, "the vehicle has not turned");
  EXPECT_EQ(report.find(Calibrator::compass)->judgement.reason, "the vehicle has not turned");
  EXPECT_FALSE(report.find(Calibrator::compass_delay)->judgement.accepted);
  EXPECT_FALSE(report.find(Calibrator::magnetometer)->judgement.accepted);
}

TEST(Suite, EstimatesComeIntoForceWhenTheyAreBetterOnReadingsHeldOut) {
  const Report report = run("path_long600", thesis_options());
  ASSERT_TRUE(report.in_force.gyro && report.in_force.gyro_b && report.in_force.compass);
  EXPECT_NEAR(report.in_force.gyro->scale, kTrueScale, 0.02);
  EXPECT_LT(worst_heading_error_deg(*report.in_force.compass), 1.5);
  EXPECT_EQ(report.find(Calibrator::compass)->verdict, Verdict::in_force);
  ASSERT_GT(report.heading.blocks, 10U);
  EXPECT_LT(report.heading.after_rad, 0.5 * report.heading.before_rad);
  EXPECT_LT(report.heading.after_rad, 0.5 * base::kRadiansPerDegree);
  EXPECT_GE(report.name.number, 3U);
}

TEST(Suite, WhatIsRightAlreadyIsNotReplacedByChance) {
  int changes = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Suite suite(thesis_options(), {true, false, false, false});
    Suite with_gyros(thesis_options(), kCompassAndGyros);
    for (const Reading& reading : readings_along("path_long600", Deviation::Zero(), {}, seed)) {
      if (std::holds_alternative<CompassReading>(reading)) suite.put(reading);
      with_gyros.put(reading);
      while (const auto adopted = with_gyros.take_adopted()) {
        // The gyros are wrong, and are to be corrected.
        if (*adopted != Calibrator::gyro && *adopted != Calibrator::gyro_b) ++changes;
      }
      while (suite.take_adopted()) ++changes;
    }
  }
  EXPECT_EQ(changes, 0);
}

TEST(Suite, WithoutAutomaticEverythingStaysInShadowUntilTheOperatorSpeaks) {
  SuiteOptions options = thesis_options();
  options.automatic = false;
  Suite suite(options, kCompassAndGyros);
  for (const Reading& reading : readings_along("path2", thesis_deviation(), {}, 1)) suite.put(reading);
  EXPECT_EQ(suite.report().find(Calibrator::gyro)->verdict, Verdict::shadow);
  EXPECT_EQ(suite.in_force().name().text(), "none");
  EXPECT_EQ(suite.accept(Calibrator::gyro), "");
  EXPECT_EQ(suite.report().find(Calibrator::gyro)->verdict, Verdict::in_force);
  EXPECT_EQ(suite.in_force().name().number, 1U);
  EXPECT_NE(suite.accept(Calibrator::magnetometer), "") << "refused ones cannot be accepted";
  EXPECT_EQ(suite.roll_back(Calibrator::gyro), "");
  EXPECT_FALSE(suite.in_force().correction().gyro);
  EXPECT_EQ(suite.in_force().name().number, 2U);
  EXPECT_NE(suite.roll_back(Calibrator::gyro), "") << "there is nothing more to take back";
}

TEST(Suite, TheOperatorMayForceWhatIsRefused) {
  Suite suite(thesis_options(), kCompassAndGyros);
  for (const Reading& reading : readings_along("path3", thesis_deviation(), {}, 1)) suite.put(reading);
  ASSERT_FALSE(suite.report().find(Calibrator::compass)->judgement.accepted);
  const std::string refusal = suite.accept(Calibrator::compass);
  EXPECT_NE(refusal.find("\"force\":true"), std::string::npos) << refusal;
  EXPECT_EQ(suite.accept(Calibrator::compass, true), "");
  EXPECT_EQ(suite.report().find(Calibrator::compass)->verdict, Verdict::in_force);
  EXPECT_EQ(suite.roll_back(Calibrator::compass), "");
  EXPECT_NE(suite.accept(Calibrator::misalignment, true), "") << "there is nothing to force";
}

TEST(Suite, WhatWasRolledBackStaysSo) {
  const auto readings = readings_along("path_long600", thesis_deviation(), {}, 1);
  Suite suite(thesis_options(), kCompassAndGyros);
  std::size_t i = 0;
  for (; i < readings.size() && !suite.in_force().correction().compass; ++i) suite.put(readings[i]);
  ASSERT_LT(i, readings.size());
  ASSERT_EQ(suite.roll_back(Calibrator::compass), "");
  for (; i < readings.size(); ++i) suite.put(readings[i]);
  EXPECT_FALSE(suite.in_force().correction().compass);
  EXPECT_TRUE(suite.report().find(Calibrator::compass)->held);
  EXPECT_EQ(suite.accept(Calibrator::compass), "");
  EXPECT_TRUE(suite.in_force().correction().compass);
}

TEST(Suite, StartForgetsWhatOneCalibratorHasSeen) {
  Suite suite(thesis_options(), kCompassAndGyros);
  for (const Reading& reading : readings_along("path2", thesis_deviation(), {}, 1)) suite.put(reading);
  ASSERT_TRUE(suite.report().find(Calibrator::gyro_b)->judgement.accepted);
  EXPECT_EQ(suite.start(Calibrator::gyro_b), "");
  const Report report = suite.report();
  EXPECT_EQ(report.find(Calibrator::gyro_b)->judgement.samples, 0U);
  EXPECT_TRUE(report.find(Calibrator::gyro)->judgement.accepted);
}

// Turning to one side alone is turning: both ends of the turn count.
TEST(Suite, TurnsToEitherSideAreJudged) {
  for (const double side : {-1.0, 1.0}) {
    Suite suite(thesis_options(), kCompassAndGyros);
    Random random(5);
    std::normal_distribution<double> noise(0, 0.004);
    double heading_rad = 0;
    for (int i = 0; i < 3000; ++i) {
      const double rate_rad_s = side * (0.2 + 0.1 * std::sin(0.05 * i));
      suite.put(
          RateReading{i * 0.1, {0, 0, (rate_rad_s - kTrueBias_rad_s) / kTrueScale + 0.1 * noise(random)}, {}, {}});
      suite.put(CompassReading{
          i * 0.1, base::wrapped(heading_rad + 0.1 * std::sin(heading_rad) + noise(random)), 0.0, 0.0, {}, false});
      heading_rad += 0.1 * rate_rad_s;
    }
    suite.finish();
    EXPECT_GT(suite.report().heading.blocks, 20U) << side;
    EXPECT_GT(suite.report().heading.before_rad, 0.02) << side;
    EXPECT_LT(suite.report().heading.after_rad, 0.01) << side;
  }
}

// A state saved after finish() goes on as the suite itself does.
TEST(Suite, AfterItsFinishItGoesOnLikeOneThatWasRestored) {
  const auto readings = readings_along("path5", thesis_deviation(), {}, 7);
  Suite whole(thesis_options(), kCompassAndGyros);
  for (std::size_t i = 0; i < 333; ++i) whole.put(readings[i]);
  whole.finish();
  Suite again = restored(test::saved(whole), thesis_options(), kCompassAndGyros);
  for (std::size_t i = 333; i < readings.size(); ++i) {
    whole.put(readings[i]);
    again.put(readings[i]);
  }
  EXPECT_EQ(test::saved(again), test::saved(whole));
}

// Deviation against an external reference of true headings. What is in force is judged as it corrects, so what is
// right comes into force once.
TEST(Suite, AReferenceOfTrueHeadingsBringsItsDeviationIntoForceOnce) {
  Suite suite(thesis_options(),
              {.compass = true, .rate = false, .ground = false, .motor = false, .reference = true});
  const Calibrator calibrator = calibrator_named("reference_compass").value();
  Random random(6);
  std::normal_distribution<double> noise(0, 0.002);
  const auto go = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      const double time_s = i * 0.1, heading_rad = base::wrapped(0.05 * i);
      suite.put(ReferenceReading{time_s, 1e-4, heading_rad, 0.002});
      suite.put(CompassReading{time_s,
                               base::wrapped(heading_rad + 0.1 + 0.05 * std::sin(heading_rad) + noise(random)),
                               0.0,
                               0.0,
                               {},
                               false});
    }
  };
  go(0, 4000);
  const Report report = suite.report();
  const auto& judgement = report.find(calibrator)->judgement;
  ASSERT_TRUE(judgement.accepted) << judgement.reason;
  EXPECT_NEAR(judgement.held_out_before, std::sqrt(0.01 + 0.00125), 0.005);
  EXPECT_LT(judgement.held_out_after, 0.01);
  EXPECT_EQ(report.find(calibrator)->verdict, Verdict::in_force);
  EXPECT_NEAR(report.find(calibrator)->quantity("A_rad")->value, 0.1, 0.01);
  EXPECT_NEAR(report.find(calibrator)->quantity("B_rad")->value, 0.05, 0.01);
  EXPECT_NEAR(report.find(calibrator)->quantity("delay_s")->value, 0, 0.02);
  const std::uint32_t number = suite.in_force().name().number;
  go(4000, 12000);
  EXPECT_EQ(suite.in_force().name().number, number);
}

TEST(Suite, SavedAndRestoredItGoesOnBitForBit) {
  const auto readings = readings_along("path5", thesis_deviation(), {}, 7);
  Suite whole(thesis_options(), kCompassAndGyros);
  Suite first(thesis_options(), kCompassAndGyros);
  std::optional<Suite> second;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    whole.put(readings[i]);
    if (second) {
      second->put(readings[i]);
    } else {
      first.put(readings[i]);
    }
    if (i != 333) continue;
    const std::string state = test::saved(first);
    second = restored(state, thesis_options(), kCompassAndGyros);
    ASSERT_EQ(test::saved(*second), state);
  }
  EXPECT_EQ(test::saved(*second), test::saved(whole));
  // Two states are equal also where both lack the same member.
  EXPECT_EQ(second->report().rose, whole.report().rose);
}

}  // namespace
}  // namespace navcal::calib
