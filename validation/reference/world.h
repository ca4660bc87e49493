// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "validation/reference/history.h"
#include "validation/reference/vehicle.h"
#include "validation/reference/waters.h"

namespace navcal::reference {

/// The vehicle with its recent past.
class World : public History {
 public:
  /// `memory_s`: how far back at() may reach.
  World(Vehicle vehicle, double memory_s, double surface_C = Waters{}.surface_C);

  /// A whole number of steps of the vehicle on.
  void advance(double to_s);

  [[nodiscard]] Vehicle& vehicle() { return vehicle_; }

 private:
  Vehicle vehicle_;
};

}  // namespace navcal::reference
