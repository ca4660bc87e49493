// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

instruments::CompassSample east_sample() {
  instruments::CompassSample sample;
  sample.field_body_uT = instruments::Vector3{0, -20, 40};  // north is to port: the vehicle heads east
  sample.roll_rad = 0;
  sample.pitch_rad = 0;
  return sample;
}

TEST(CalibReading, ASampleWithoutAHeadingGetsThatOfItsField) {
  const auto reading = calib_reading(east_sample(), {}, 0);
  ASSERT_TRUE(reading.heading_rad);
  EXPECT_NEAR(*reading.heading_rad, std::numbers::pi / 2, 1e-12);
}

TEST(CalibReading, ATrueHeadingIsNotTakenForMagnetic) {
  auto sample = east_sample();
  sample.heading_rad = 1.7;
  sample.heading_is_true = true;
  EXPECT_NEAR(calib_reading(sample, {}, 0).heading_rad.value(), std::numbers::pi / 2, 1e-12);
  sample.heading_is_true = false;
  EXPECT_EQ(calib_reading(sample, {}, 0).heading_rad, 1.7);
}

TEST(CalibReading, WithoutTiltThereIsNoHeading) {
  auto sample = east_sample();
  sample.pitch_rad.reset();
  EXPECT_FALSE(calib_reading(sample, {}, 0).heading_rad);
}

}  // namespace
}  // namespace navcal::pipeline
