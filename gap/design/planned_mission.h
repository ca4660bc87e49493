// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "config/mission.h"
#include "config/vehicle.h"
#include "devices/instrument_model.h"
#include "gap/data/earth_field.h"
#include "gap/data/mission.h"
#include "sim/effects/effect_set.h"

namespace navcal::gap {

/// State of the nominal vehicle at one second of a planned mission.
struct PlannedInstant {
  double time_s = 0;
  double north_m = 0, east_m = 0, depth_m = 0;
  double heading_rad = 0, pitch_rad = 0;
  double speed_m_s = 0, turn_rate_rad_s = 0;
  double shaft_rps = 0, motor_current_A = 0;
};

/// A mission that was not sailed yet, as the nominal vehicle would record it.
struct PlannedMission {
  Mission mission;
  std::vector<PlannedInstant> track;  ///< one for each second
};

/// Where and with what a mission would be sailed. References; valid as long as what they refer to.
struct Waters {
  const config::VehicleSettings& vehicle;
  const devices::InstrumentModel& instruments;
  const EarthField& field;
};

/// Simulates a mission with its autopilot, its instruments down to their bytes. Throws sim::UnstableVehicle.
[[nodiscard]] PlannedMission planned_mission(const config::Mission& steps, double seconds, const Waters& waters,
                                             std::uint64_t seed);

}  // namespace navcal::gap
