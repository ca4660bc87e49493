// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/thruster_force.h"

#include "sim/layout/vector_of.h"

namespace navcal::sim {

ThrusterForce::ThrusterForce(const config::LayoutThruster& thruster, double density_kg_m3)
    : thruster_(thruster), density_kg_m3_(density_kg_m3),
      of_thrust_(force_at(vector_of(thruster.place_m), vector_of(thruster.direction).normalized())) {}

}  // namespace navcal::sim
