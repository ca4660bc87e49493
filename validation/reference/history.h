// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "validation/reference/snapshot.h"

namespace navcal::reference {

/// Effects of temperature are reckoned from here.
inline constexpr double kReferenceTemperature_C = 15;

/// The recent past of a vehicle, so that an instrument can ask what was at a time between two steps or some
/// seconds ago. Electronics warm from the water's temperature at power-on (15 C at the surface unless said
/// otherwise, less 0.25 C a metre) towards 8 C above it: T' = (T_water(z) + 8 C - T) / 200 s.
class History {
 public:
  /// `step_s`: from one snapshot to the next. `memory_s`: how far back at() may reach.
  History(const Snapshot& first, double step_s, double memory_s, double surface_C);

  /// The state one step on; the history gives it the temperature of the electronics.
  void remember(Snapshot next);
  /// Before the beginning everything was as at the beginning.
  [[nodiscard]] Snapshot at(double time_s) const;
  [[nodiscard]] const Snapshot& now() const { return past_.back(); }

 private:
  [[nodiscard]] double water_C(double depth_m) const;

  double step_s_, memory_s_;
  double surface_C_;
  std::deque<Snapshot> past_;
};

}  // namespace navcal::reference
