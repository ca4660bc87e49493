// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/surface_force.h"

#include "sim/layout/vector_of.h"

namespace navcal::sim {

SurfaceForce::SurfaceForce(const config::LayoutSurface& surface, double density_kg_m3)
    : pressure_kg_m_(0.5 * density_kg_m3 * surface.area_m2), slope_(surface.lift_slope_per_rad),
      induced_(surface.induced_drag), drag_(surface.drag), stall_rad_(surface.stall_rad),
      of_normal_(force_at(vector_of(surface.place_m), vector_of(surface.normal).normalized())),
      of_chord_(force_at(vector_of(surface.place_m), vector_of(surface.chord).normalized())) {}

}  // namespace navcal::sim
