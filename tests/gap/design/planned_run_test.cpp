// SPDX-License-Identifier: Apache-2.0
#include "gap/design/planned_run.h"

#include <gtest/gtest.h>

#include "config/mission_file.h"
#include "gap/replay/replay.h"
#include "gap/thresholds.h"

namespace navcal::gap::test {
namespace {

TEST(PlannedReadings, HasTheOrdersThatTheFinsFollow) {
  const config::VehicleSettings vehicle;
  const Mission readings = planned_readings(vehicle, config::load_mission("identification"), {}, 60);
  ASSERT_FALSE(readings.ordered_fins_rad.empty());
  EXPECT_LT(Replay(readings, vehicle).actuators().orders().misfit(), kMostCommandMisfit);
}

}  // namespace
}  // namespace navcal::gap::test
