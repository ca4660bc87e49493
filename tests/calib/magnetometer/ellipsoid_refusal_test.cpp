// SPDX-License-Identifier: Apache-2.0
// What others accept wrongly (too little of the sphere seen), and what must be accepted.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "calib/magnetometer/ellipsoid_estimator.h"
#include "tests/calib/magnetometer_paths.h"

namespace navcal::calib::test {
namespace {

EllipsoidEstimator fitted(const std::vector<Attitude>& motion, const Iron& iron, bool known) {
  Random random(11);
  EllipsoidEstimator::Parameters parameters;
  if (known) parameters.known = reference_field();
  EllipsoidEstimator estimator(parameters);
  for (const auto& r : field_on(motion, iron, random)) estimator.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
  estimator.settle();
  return estimator;
}

void expect_refused(const EllipsoidEstimator& estimator, const std::string& reason) {
  const Judgement judgement = estimator.judgement();
  EXPECT_FALSE(judgement.accepted);
  EXPECT_NE(judgement.reason.find(reason), std::string::npos) << judgement.reason;
  EXPECT_FALSE(judgement.manoeuvre.empty());
  std::printf("  %s -> %s\n", judgement.reason.c_str(), judgement.manoeuvre.c_str());
}

TEST(EllipsoidRefusal, GliderWhoseHardIronExceedsTheField) {
  Iron iron;
  iron.hard_uT = {45, -30, 25};
  for (const bool known : {false, true}) {
    expect_refused(fitted(swinging(1200, 720, 15, 20), iron, known), "exceeds the Earth's field");
  }
}

TEST(EllipsoidRefusal, DiveWithYawWithin120Degrees) {
  for (const bool known : {false, true}) {
    expect_refused(fitted(swinging(1200, 120, 4, 25), some_iron(), known), "headings within 1");
  }
}

TEST(EllipsoidRefusal, PlanarSwingAskedForAVerticalOffset) {
  for (const bool known : {false, true}) {
    expect_refused(fitted(swinging(1200, 1080, 0, 0), some_iron(), known), "vertical offset");
  }
}

TEST(EllipsoidRefusal, NoTurnAtAll) { expect_refused(fitted(swinging(1200, 0, 5, 5), some_iron(), true), ""); }

TEST(EllipsoidAcceptance, AWholeSphere) {
  const auto estimator = fitted(swinging(2400, 2160, 170, 80), some_iron(), false);
  EXPECT_TRUE(estimator.judgement().accepted) << estimator.judgement().reason;
  EXPECT_LT((estimator.estimate()->correction.offset_uT - some_iron().hard_uT).norm(), 0.1);
}

TEST(EllipsoidAcceptance, TheTiltOfAStableHullInAKnownField) {
  const auto estimator = fitted(swinging(2400, 1440, 12, 10), some_iron(), true);
  const auto estimate = *estimator.estimate();
  std::printf("  offset off by %.3f %.3f %.3f uT, stated %.3f %.3f %.3f\n",
              estimate.correction.offset_uT.x() - some_iron().hard_uT.x(),
              estimate.correction.offset_uT.y() - some_iron().hard_uT.y(),
              estimate.correction.offset_uT.z() - some_iron().hard_uT.z(), estimate.offset_std_uT.x(),
              estimate.offset_std_uT.y(), estimate.offset_std_uT.z());
  EXPECT_TRUE(estimator.judgement().accepted) << estimator.judgement().reason;
  const Eigen::Vector3d off = estimate.correction.offset_uT - some_iron().hard_uT;
  for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(off[i]), 4 * estimate.offset_std_uT[i] + 0.05);
}

}  // namespace
}  // namespace navcal::calib::test
