// SPDX-License-Identifier: Apache-2.0
#include "calib/reference/heading_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "base/angles.h"
#include "calib/correction.h"
#include "calib/suite/suite.h"

namespace navcal::calib {
namespace {

constexpr double kDegree_rad = base::kRadiansPerDegree;
constexpr std::array<double, 5> kTruth_rad{2.5 * kDegree_rad, 3 * kDegree_rad, -2 * kDegree_rad, 0.8 * kDegree_rad,
                                           -0.5 * kDegree_rad};

/// Noise of a reference: white, and slow with a correlation time.
struct ReferenceNoise {
  double white_rad = 0, slow_rad = 0, slow_s = 20;
};

/// A compass with kTruth_rad at 10 Hz that turns through all headings, and a reference at 5 Hz.
class ReferenceTurn {
 public:
  explicit ReferenceTurn(unsigned seed) : engine_(seed) {}

  HeadingReference run(double duration_s, const ReferenceNoise& noise, double stated_rad,
                       double declination_rad = 0, double sector_rad = 0) {
    HeadingReference estimator({.heading_noise_rad = kCompass_rad});
    ReferenceTrack track;
    double slow_rad = noise.slow_rad * normal_(engine_);
    const double keep = std::exp(-0.1 / noise.slow_s);
    for (int i = 0; i * 0.1 < duration_s; ++i) {
      const double t = i * 0.1 + 100;
      slow_rad = keep * slow_rad + std::sqrt(1 - keep * keep) * noise.slow_rad * normal_(engine_);
      if (i % 2 == 0) {
        // Between two readings of the compass.
        const double reference_rad =
            true_rad(t - 0.05, declination_rad, sector_rad) + slow_rad + noise.white_rad * normal_(engine_);
        track.update({t - 0.05, 0, base::as_heading(reference_rad), stated_rad});
      }
      track.update({t, 0, base::as_heading(measured_rad(t, sector_rad) + kCompass_rad * normal_(engine_))},
                   [&](const HeadingPair& pair) { estimator.update(pair); });
    }
    return estimator;
  }
  static constexpr double kCompass_rad = 0.4 * kDegree_rad;

 private:
  static double measured_rad(double t, double sector_rad) {
    return sector_rad > 0 ? sector_rad * std::sin(0.1 * t) : 0.12 * t + 1.5 * std::sin(0.05 * t);
  }
  /// True heading at which the compass measures measured_rad().
  static double true_rad(double t, double declination_rad, double sector_rad) {
    const DeviationCorrection deviation{kTruth_rad};
    return deviation(measured_rad(t, sector_rad)) + declination_rad;
  }

  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

TEST(HeadingReference, FindsAllFiveCoefficients) {
  const auto found = ReferenceTurn(1).run(300, {.white_rad = 0.1 * kDegree_rad}, 0.1 * kDegree_rad).estimate(0);
  ASSERT_TRUE(found);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(found->coefficients[i], kTruth_rad[static_cast<std::size_t>(i)], 0.06 * kDegree_rad) << i;
    EXPECT_LT(std::sqrt(found->covariance(i, i)), 0.04 * kDegree_rad) << i;
  }
  EXPECT_NEAR(found->residual_rad, std::hypot(0.1, 0.4 * std::numbers::sqrt2 / 2) * kDegree_rad,
              0.03 * kDegree_rad)
      << "half-way between two readings a heading has half their variance";
}

TEST(HeadingReference, TheDeclinationIsTakenOffAndNoSeamMatters) {
  for (const double declination_rad : {-3.0, -0.1, 0.2, 3.1}) {
    const auto found = ReferenceTurn(2)
                           .run(200, {.white_rad = 0.1 * kDegree_rad}, 0.1 * kDegree_rad, declination_rad)
                           .estimate(declination_rad);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->coefficients[0], kTruth_rad[0], 0.1 * kDegree_rad) << declination_rad;
    EXPECT_NEAR(found->coefficients[1], kTruth_rad[1], 0.1 * kDegree_rad) << declination_rad;
  }
}

// The errors that are stated are those that are made, of white references and of slow ones, whatever is stated for
// the reference.
TEST(HeadingReference, StatedErrorsHold) {
  for (const ReferenceNoise& noise :
       {ReferenceNoise{.white_rad = 0.3 * kDegree_rad},
        ReferenceNoise{.white_rad = 0.2 * kDegree_rad, .slow_rad = 0.3 * kDegree_rad}}) {
    for (const double stated_rad : {0.3 * kDegree_rad, 0.1 * kDegree_rad}) {
      int within = 0, count = 0, offsets_within = 0;
      for (unsigned seed = 1; seed <= 80; ++seed) {
        const auto found = ReferenceTurn(seed).run(400, noise, stated_rad).estimate(0);
        ASSERT_TRUE(found);
        for (int i = 0; i < 5; ++i, ++count) {
          const double error = found->coefficients[i] - kTruth_rad[static_cast<std::size_t>(i)];
          const bool is_within = std::abs(error) <= 1.96 * std::sqrt(found->covariance(i, i));
          within += is_within ? 1 : 0;
          offsets_within += is_within && i == 0 ? 1 : 0;
        }
      }
      const double share = static_cast<double>(within) / count;
      EXPECT_GE(share, 0.90) << noise.slow_rad << ' ' << stated_rad;
      EXPECT_GE(offsets_within, 68) << "A, of 80: slow errors of the reference are in it";
      EXPECT_LE(share, 0.99) << noise.slow_rad << ' ' << stated_rad;
    }
  }
}

TEST(HeadingReference, OneSectorIsRefusedWithTheTurnThatIsMissing) {
  const auto estimator = ReferenceTurn(3).run(300, {.white_rad = 0.2 * kDegree_rad}, 0.2 * kDegree_rad, 0, 0.4);
  const Judgement judgement = estimator.judgement(0);
  EXPECT_FALSE(judgement.accepted);
  EXPECT_NE(judgement.reason.find("the heading would be uncertain by"), std::string::npos) << judgement.reason;
  EXPECT_NE(judgement.manoeuvre.find("turn through"), std::string::npos) << judgement.manoeuvre;
  EXPECT_TRUE(
      ReferenceTurn(3).run(300, {.white_rad = 0.2 * kDegree_rad}, 0.2 * kDegree_rad).judgement(0).accepted);
  const Judgement brief =
      ReferenceTurn(3).run(80, {.white_rad = 0.1 * kDegree_rad}, 0.1 * kDegree_rad).judgement(0);
  EXPECT_FALSE(brief.accepted);
  EXPECT_NE(brief.reason.find("less than 100 s"), std::string::npos) << brief.reason;
  EXPECT_FALSE(HeadingReference().judgement(0).accepted);
  EXPECT_FALSE(HeadingReference().judgement(0).reason.empty());
}

TEST(HeadingReference, HoursTakeNoMoreMemoryAndMinutesCountAsMuch) {
  const auto found = ReferenceTurn(4).run(7000, {.white_rad = 0.1 * kDegree_rad}, 0.1 * kDegree_rad).estimate(0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->coefficients[0], kTruth_rad[0], 0.02 * kDegree_rad);
  EXPECT_LT(std::sqrt(found->covariance(0, 0)), 0.006 * kDegree_rad);
}

TEST(ReferenceTrack, PairsAreOfOneInstantAndNeverAcrossAGap) {
  ReferenceTrack track;
  std::vector<HeadingPair> pairs;
  const auto use = [&](const HeadingPair& pair) { pairs.push_back(pair); };
  track.update({0.9, 0, 1, 0.01});   // before all headings
  track.update({1.05, 0, 1, 0.01});  // half-way
  track.update({1.06, 0, 1, 0.01});  // too soon after the one before
  track.update({1.5, 0, 1, 0.01});   // in a gap
  track.update({2.14, 0.02, 1, 0.01});
  track.update({2.3, 0, 1, 0});  // without an error
  track.update({1.0, 0, 6.2}, use);
  track.update({1.1, 0, 6.3}, use);
  track.update({2.1, 0, 0.1}, use);
  track.update({2.2, 0, 0.3}, use);
  track.update({2.4, 0, 0.3}, use);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs[0].heading_rad, 6.25, 1e-12);
  EXPECT_NEAR(pairs[0].variance_rad2, 1e-4, 1e-12);
  EXPECT_NEAR(pairs[1].heading_rad, 0.18, 1e-12);
  EXPECT_NEAR(pairs[1].rate_rad_s, 2, 1e-9);
  EXPECT_NEAR(pairs[1].time_std_s, 0.02, 1e-12);
}

/// A compass whose field and heading have an error, a gyro, and a reference.
struct ReferenceSuite {
  Suite suite;
  explicit ReferenceSuite(bool has_reference)
      : suite({.gate = {}, .local_field = {.declination_rad = 0.1, .known = {}}},
              {true, false, false, false, has_reference}) {}
  void drive(double from_s, double to_s) {
    for (double t = from_s; t < to_s; t += 0.1) {
      const double measured_rad = 0.12 * t + 1.5 * std::sin(0.05 * t);
      CompassReading compass;
      compass.time_s = t;
      compass.heading_rad = base::as_heading(measured_rad + 0.005 * normal(engine));
      suite.put(compass);
      const double true_rad = DeviationCorrection{kTruth_rad}(measured_rad) + 0.1;
      suite.put(ReferenceReading{t, 0.001, base::as_heading(true_rad + 0.003 * normal(engine)), 0.003});
    }
  }
  std::mt19937 engine{7};
  std::normal_distribution<double> normal;
};

TEST(ReferenceUnits, ComeIntoForceByThemselvesWithA) {
  ReferenceSuite driven(true);
  driven.drive(0, 300);
  const auto calibrator = *calibrator_named("reference_compass");
  EXPECT_EQ(driven.suite.take_adopted(), calibrator);
  CompassReading compass;
  compass.heading_rad = 1.0;
  const auto corrected = corrected_heading(driven.suite.in_force().correction(), compass);
  ASSERT_TRUE(corrected);
  EXPECT_NEAR(*corrected, DeviationCorrection{kTruth_rad}(1.0), 0.2 * kDegree_rad) << "magnetic, and without A";
  // What GPS says of A is not taken off once more.
  Correction both = driven.suite.in_force().correction();
  both.misalignment_rad = 0.5;
  EXPECT_EQ(corrected_heading(both, compass), corrected);
  const Report report = driven.suite.report();
  const CalibratorReport* const found = report.find(calibrator);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(name_of(found->verdict), "in_force");
  EXPECT_LT(found->judgement.held_out_after, 0.5 * kDegree_rad);
  EXPECT_GT(found->judgement.held_out_before, 2 * kDegree_rad);
  const CalibratorReport* const of_field = report.find(*calibrator_named("reference_field"));
  ASSERT_NE(of_field, nullptr);
  EXPECT_NE(of_field->judgement.reason.find("no calibration of the magnetometer is active"), std::string::npos);
}

TEST(ReferenceUnits, WithoutAReferenceThereIsNone) {
  ReferenceSuite driven(false);
  driven.drive(0, 100);
  EXPECT_EQ(driven.suite.report().find(*calibrator_named("reference_compass")), nullptr);
}

TEST(ReferenceUnits, AreSavedAndRestoredExactly) {
  ReferenceSuite driven(true), same(true);
  driven.drive(0, 150);
  Archive saving;
  driven.suite.archive(saving);
  Archive restoring{std::string_view(saving.bytes())};
  same.suite.archive(restoring);
  ASSERT_TRUE(restoring.ok() && restoring.at_end());
  same.engine = driven.engine;
  same.normal = driven.normal;
  driven.drive(150, 250);
  same.drive(150, 250);
  Archive one, other;
  driven.suite.archive(one);
  same.suite.archive(other);
  EXPECT_EQ(one.bytes(), other.bytes());
}

TEST(ReferenceOffset, ServesTheOtherHeadingOfTheCompass) {
  Correction correction;
  correction.magnetometer = FieldCorrection{};
  const std::array<double, 5> deviation{0.25, 0.1, 0, 0, 0};
  correction.added.set(*calibrator_named("reference_compass"), deviation);
  CompassReading compass;
  compass.heading_rad = 0.3;
  compass.pitch_rad = compass.roll_rad = 0;
  compass.field_body_uT = Eigen::Vector3d(20, 0, 40);
  EXPECT_NEAR(std::remainder(*corrected_heading(correction, compass), base::kTurn_rad), -0.25, 1e-12)
      << "A, and no harmonics";
  correction.added.set(*calibrator_named("reference_field"), std::array<double, 5>{0.2, 0, 0.05, 0, 0});
  EXPECT_NEAR(std::remainder(*corrected_heading(correction, compass), base::kTurn_rad), -0.25, 1e-12)
      << "its own A and C";
  compass.field_body_uT.reset();
  EXPECT_NEAR(*corrected_heading(correction, compass), 0.3 - 0.25 - 0.1 * std::sin(0.3), 1e-12);
}

}  // namespace
}  // namespace navcal::calib
