// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "validation/reference/snapshot.h"
#include "validation/reference/vehicle.h"
#include "validation/reference/waters.h"

namespace navcal::reference {

/// Effects of temperature are reckoned from here.
inline constexpr double kReferenceTemperature_C = 15;

/// The vehicle with its recent past, so that an instrument can ask what was at a time between two steps or some
/// seconds ago. Electronics warm from the water's temperature at power-on (15 C at the surface unless said
/// otherwise, less 0.25 C a metre) towards 8 C above it: T' = (T_water(z) + 8 C - T) / 200 s.
class World {
 public:
  /// `memory_s`: how far back at() may reach.
  World(Vehicle vehicle, double memory_s, double surface_C = Waters{}.surface_C);

  /// A whole number of steps of the vehicle on.
  void advance(double to_s);
  /// Before the beginning everything was as at the beginning.
  [[nodiscard]] Snapshot at(double time_s) const;

  [[nodiscard]] Vehicle& vehicle() { return vehicle_; }
  [[nodiscard]] const Snapshot& now() const { return past_.back(); }

 private:
  void remember(double step_s);
  [[nodiscard]] double water_C(double depth_m) const;

  Vehicle vehicle_;
  double memory_s_;
  double surface_C_;
  std::deque<Snapshot> past_;
};

}  // namespace navcal::reference
