// SPDX-License-Identifier: Apache-2.0
// Recordings of real instruments; the figures of other tools are in ../shared/data/ORIGIN.md.
#include "tests/calib/magnetometer/magnetometer_recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "calib/magnetometer/ellipsoid_estimator.h"
#include "calib/magnetometer/magnetometer.h"

namespace navcal::calib::test {
namespace {

std::vector<RecordedField> recording(const char* name) {
  return recorded_field(std::string(NAVCAL_SHARED_DIR "/data/") + name);
}

using Chosen = std::function<bool(const RecordedField&)>;

EllipsoidEstimator fitted(const std::vector<RecordedField>& readings, const Chosen& chosen) {
  EllipsoidEstimator estimator({});
  for (const auto& r : readings) {
    if (chosen(r)) estimator.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
  }
  estimator.settle();
  return estimator;
}

double spread(const EllipsoidEstimator& estimator, const std::vector<RecordedField>& readings,
              const Chosen& chosen) {
  const FieldCorrection correction = estimator.estimate()->correction;
  std::vector<double> sizes;
  for (const auto& r : readings) {
    if (chosen(r)) sizes.push_back(correction(r.field_body_uT).norm());
  }
  return spread_percent(sizes);
}

bool even_block(const RecordedField& r, double block_s) {
  return static_cast<long>(std::floor(r.time_s / block_s)) % 2 == 0;
}

TEST(MagnetometerRecording, BoardTurnedThroughTheWholeSphere) {
  const auto readings = recording("hmc_sphere.cap");
  if (readings.empty()) GTEST_SKIP() << "../shared is missing";
  const auto all = [](const RecordedField&) { return true; };
  EXPECT_LE(spread(fitted(readings, all), readings, all), 0.415);  // least squares of the size alone: 0.41
  const auto even = [](const RecordedField& r) { return even_block(r, 10); };
  const auto odd = [](const RecordedField& r) { return !even_block(r, 10); };
  EXPECT_LE(spread(fitted(readings, even), readings, odd), 0.50);  // not fitted
}

TEST(MagnetometerRecording, GliderAgreesWithItsOwnCalibration) {
  const auto readings = recording("sg171.cap");
  if (readings.empty()) GTEST_SKIP() << "../shared is missing";
  const auto all = [](const RecordedField&) { return true; };
  const auto estimator = fitted(readings, all);
  const Eigen::Vector3d own(3.07, -0.95, 0.84);
  EXPECT_LT((estimator.estimate()->correction.offset_uT - own).cwiseAbs().maxCoeff(), 0.1);
  const auto even = [](const RecordedField& r) { return even_block(r, 600); };
  const auto odd = [](const RecordedField& r) { return !even_block(r, 600); };
  EXPECT_LE(spread(fitted(readings, even), readings, odd), 0.29);  // not fitted
}

TEST(MagnetometerRecording, GliderIsAcceptedReadingByReading) {
  const auto readings = recording("sg171.cap");
  if (readings.empty()) GTEST_SKIP() << "../shared is missing";
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  for (const auto& r : readings) magnetometer.update(r.field_body_uT, r.roll_rad, r.pitch_rad);
  EXPECT_EQ(magnetometer.field_steps(), 0u);
  EXPECT_EQ(magnetometer.method(), Magnetometer::Method::ellipsoid) << magnetometer.judgement().reason;
}

TEST(MagnetometerRecording, MagnetBroughtNearAndTakenAway) {
  const auto readings = recording("broad34.cap");
  if (readings.empty()) GTEST_SKIP() << "../shared is missing";
  Magnetometer magnetometer{Magnetometer::Parameters{}};
  for (const auto& r : readings) {
    Magnetometer::Reading reading;
    reading.field_body_uT = r.field_body_uT;
    reading.roll_rad = r.roll_rad;
    reading.pitch_rad = r.pitch_rad;
    reading.time_s = r.time_s;
    magnetometer.update(reading);
  }
  magnetometer.settle();
  const auto& steps = magnetometer.history().steps();
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_NEAR(steps[0].time_s, 45.3, 0.6);
  EXPECT_NEAR(steps[1].time_s, 99.7, 0.6);
  const Eigen::Vector3d size_uT(-1.5, -0.5, -13.6);
  // The board rested before the magnet came, at a heading that the field alone does not tell.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(steps[0].size_uT[i], size_uT[i], 3 * steps[0].std_uT[i]) << steps[0].size_uT.transpose();
    EXPECT_NEAR(steps[1].size_uT[i], -size_uT[i], 3 * steps[1].std_uT[i]) << steps[1].size_uT.transpose();
  }
  EXPECT_LT((steps[1].size_uT + size_uT).norm(), 1) << steps[1].size_uT.transpose();
  const auto on = [](const RecordedField& r) { return r.time_s > 46.5 && r.time_s < 98.5; };
  EXPECT_LE(spread(fitted(readings, on), readings, on), 1.632);
}

}  // namespace
}  // namespace navcal::calib::test
