// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "autopilot/shaft_speed.h"
#include "base/reference_instruments.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::sim {
namespace {

TEST(SteadyAdvance, TheReferenceVehicleHasThatOfTheConfiguration) {
  EXPECT_NEAR(autopilot::surge_for({}, 1), base::reference::kAdvance_m, 5e-5);
}

TEST(SteadyAdvance, AVehicleSettlesAtIt) {
  config::VehicleSettings draggy;
  draggy.hull.axial_drag *= 1.5;
  for (const auto& settings : {config::VehicleSettings{}, draggy}) {
    const LayoutVehicle vehicle(layout_of(settings));
    constexpr double kShaft_rps = 13;
    const ActuatorValues held = Controls{{0, 0, 0}, kShaft_rps}.values();
    Body body;
    body.velocity[0] = 1;
    for (int i = 0; i < 6000; ++i) body = vehicle.midpoint_step(body, held, held, 0.02);
    EXPECT_NEAR(body.velocity[0] / kShaft_rps, autopilot::surge_for(settings, 1), 2e-4);
  }
}

}  // namespace
}  // namespace navcal::sim
