// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

#include "config/mission_file.h"
#include "sim/layout/layout_of.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::sim::testing {

inline constexpr double kDegrees = 180 / std::numbers::pi;

/// The same controls all the time.
inline Body held(const LayoutVehicle& vehicle, Body body, const Controls& controls, double seconds,
                 double step_s = 0.01, const Influences& influences = {}) {
  const long steps = std::lround(seconds / step_s);
  for (long i = 0; i < steps; ++i) body = vehicle.step(body, controls.values(), step_s, influences).body;
  return body;
}

inline Body under_way(double speed_m_s) {
  Body body;
  body.velocity[0] = speed_m_s;
  return body;
}

inline std::int64_t at_s(double t_s) { return std::llround(t_s * 1e9); }

/// The reference vehicle on a mission written as TOML.
inline SimulatedMotion on_mission(std::string_view toml, const MotionOptions& options = {}) {
  return {config::VehicleSettings{},
          std::make_unique<MissionHelm>(config::VehicleSettings{}, config::parse_mission(toml, "test.toml")),
          options};
}

}  // namespace navcal::sim::testing
