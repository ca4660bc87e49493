// SPDX-License-Identifier: Apache-2.0
#include "sim/vehicle/steady_advance.h"

#include "autopilot/shaft_speed.h"

namespace navcal::sim {

double steady_advance_m(const config::VehicleSettings& vehicle) {
  constexpr double kAnySpeed_m_s = 1;  // thrust and drag grow with its square
  return kAnySpeed_m_s / autopilot::shaft_for(vehicle.propeller, vehicle.water.density_kg_m3, kAnySpeed_m_s,
                                              autopilot::axial_drag_kg_m(vehicle));
}

}  // namespace navcal::sim
