// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/mission.h"
#include "config/mission_limits.h"
#include "config/vehicle.h"
#include "gap/data/mission.h"
#include "sim/effects/effect_set.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::gap {

/// True path of a simulated vehicle on a planned mission, ten rows a second. Positions are north and east of where
/// the mission begins.
struct PlannedPath {
  std::vector<double> time_s, north_m, east_m, depth_m, heading_rad, roll_rad, pitch_rad, turn_rad_s, speed_m_s,
      shaft_rps, current_A;
  std::vector<double> step_began_s;  ///< of each step of the mission that began
  double duration_s = 0;             ///< until the last step ended
  /// Shaft speed and current are known: the vehicle has a motor card.
  bool has_card = true;
};

/// The mission without a repetition.
[[nodiscard]] config::Mission once(config::Mission mission);

/// Path of a motion until its mission is finished or `longest_s` is over, without the begins of its steps. Throws
/// sim::UnstableVehicle.
[[nodiscard]] PlannedPath path_of(const sim::SimulatedMotion& motion, const std::function<bool()>& is_finished,
                                  double longest_s);

/// Sails a mission by its autopilot, once, without instruments. `effects`: departures of the vehicle from nominal.
/// `longest_s`: the simulation ends there. Throws sim::UnstableVehicle.
[[nodiscard]] PlannedPath planned_path(const config::VehicleSettings& vehicle, const config::Mission& mission,
                                       const sim::EffectSet& effects, double longest_s);

/// Extremes of a path, in the units of the limits.
struct PathExtremes {
  double duration_s = 0, least_depth_m = 0, greatest_depth_m = 0, range_m = 0, speed_m_s = 0, turn_rad_s = 0,
         pitch_rad = 0;
  std::optional<double> shaft_rps, energy_Wh;  ///< of a vehicle with a motor card
};
[[nodiscard]] PathExtremes extremes_of(const PlannedPath& path, const config::MissionLimits& limits,
                                       double from_s = 0, double until_s = 1e9);

/// Limits that the extremes exceed, one text each: "depth 4.2 m, at most 4 m"; empty: none.
[[nodiscard]] std::vector<std::string> violations(const PathExtremes& extremes,
                                                  const config::MissionLimits& limits);

/// Instruments and field under which a planned mission is simulated.
struct PlannedInstruments {
  devices::InstrumentModel instruments;
  EarthField field;
};

/// Readings of noiseless instruments on a mission of the nominal vehicle, read by the pipeline as a recording is.
/// The gyros have no turn-on bias. Throws sim::UnstableVehicle.
[[nodiscard]] Mission planned_readings(const config::VehicleSettings& vehicle, const config::Mission& mission,
                                       const PlannedInstruments& with, double duration_s);

}  // namespace navcal::gap
