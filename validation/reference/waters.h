// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace navcal::reference {

/// Surroundings of a vehicle. The defaults are a reference that belongs to no real place.
struct Waters {
  Eigen::Vector3d field_uT{19.0, 0.6, 44.0};  ///< the Earth's: north, east, down
  double surface_C = 15;
  double density_kg_m3 = 1000;
};

}  // namespace navcal::reference
