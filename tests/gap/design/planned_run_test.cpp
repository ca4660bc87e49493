// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planned_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "config/mission_file.h"

namespace navcal::gap::test {
namespace {

TEST(PlannedReadings, HasTheOrdersThatTheFinsFollow) {
  const Mission readings = planned_readings({}, config::load_mission("identification"), {}, 60);
  double ordered_rad = 0, reported_rad = 0;
  for (const Vector3& fins_rad : readings.ordered_fins_rad)
    for (const double fin_rad : fins_rad) ordered_rad = std::max(ordered_rad, std::abs(fin_rad));
  for (const MotorReading& reading : readings.motor)
    for (const double fin_rad : reading.fins_rad) reported_rad = std::max(reported_rad, std::abs(fin_rad));
  // Servos lag behind their orders; orders and reports are rounded to a tenth of a degree.
  EXPECT_GT(reported_rad, 1 * base::kRadiansPerDegree);
  EXPECT_GT(ordered_rad, reported_rad - 0.2 * base::kRadiansPerDegree);
  EXPECT_LT(ordered_rad, 2 * reported_rad);
}

}  // namespace
}  // namespace navcal::gap::test
