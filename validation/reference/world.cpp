// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/world.h"

#include <cmath>
#include <utility>

namespace navcal::reference {

World::World(Vehicle vehicle, double memory_s, double surface_C)
    : History(vehicle.snapshot(), Vehicle::kStep_s, memory_s, surface_C), vehicle_(std::move(vehicle)) {}

void World::advance(double to_s) {
  const double begin_s = vehicle_.time_s();
  const auto steps = std::llround((to_s - begin_s) / Vehicle::kStep_s);
  for (long long i = 1; i <= steps; ++i) {
    vehicle_.advance(begin_s + static_cast<double>(i) * Vehicle::kStep_s);
    remember(vehicle_.snapshot());
  }
}

}  // namespace navcal::reference
