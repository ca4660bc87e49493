// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "validation/reference/history.h"
#include "validation/reference/instrument.h"
#include "validation/reference/mission.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/sink.h"
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

/// Properties of the vehicle, apart from its mission.
struct VehicleUnderTest {
  Hull hull;
  ParameterDeviations deviations;
  /// Share by which the period of each of these cards is too long, beside `clock_ppm`.
  struct Clocks {
    double compass = 0, card = 0, motor = 0;
  };
  Clocks clocks;
  double clock_ppm = 30;         ///< one standard deviation of how slow the clock of each card runs
  double host_delay_s = 0.0001;  ///< mean delay of a read
  bool noisy = true;
};

/// When a vehicle lost all bounds, and where it was when last seen.
struct Lost {
  double time_s = 0;
  Snapshot last;
};

/// Swims the mission and hands over what its computer would have read and written, in order of time. The same seed
/// gives the same bytes. Memory is bounded, whatever the duration. Answers whether the vehicle was lost.
/// Throws std::invalid_argument when the orders are not in order of time or a number is not finite.
[[nodiscard]] std::optional<Lost> run(const Mission& mission, const VehicleUnderTest& specimen, std::uint64_t seed,
                                      Sink& sink);

}  // namespace navcal::reference
