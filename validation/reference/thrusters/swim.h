// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "validation/reference/receiver.h"
#include "validation/reference/run.h"
#include "validation/reference/sink.h"
#include "validation/reference/thrusters/effects.h"
#include "validation/reference/thrusters/outputs.h"
#include "validation/reference/thrusters/pilot.h"
#include "validation/reference/waters.h"

namespace navcal::reference::thrusters {

/// One mission of a vehicle with thrusters.
struct Swim {
  std::int64_t start_ns = 0;  ///< UTC: power-on
  double duration_s = 180;
  Start start;
  std::vector<Leg> legs;  ///< in order of time; before the first nothing turns
  Anchorage anchorage;
  Waters waters;  ///< the density is the layout's: a vehicle is trimmed where it swims
  double floor_m = 25;
};

/// A vehicle: what its pilot believes, what it is, and how its surroundings differ from what a layout can say.
struct CraftUnderTest {
  Plan layout;  ///< that the pilot knows
  Plan real;
  Differences differences;
  Nature nature;
  Doppler::Errors doppler;
  double compass_clock = 0, card_clock = 0;  ///< share by which the periods of these are too long
  bool noisy = true;
};

/// Swims it and hands over what the vehicle's computer would have read, in order of time: instruments, and its own
/// outputs as lines (output_line), each 5 ms after they took effect. The same seed gives the same bytes.
/// Answers where the vehicle was lost: beyond all bounds, more than 75 degrees from upright, out of the water
/// or within a metre of the floor. Throws std::invalid_argument for legs out of order.
[[nodiscard]] std::optional<Lost> run(const Swim& swim, const CraftUnderTest& craft, std::uint64_t seed,
                                      Sink& sink);

/// A mission by the dice: floats until fixes come, then legs of 6 to 10 s on drawn headings, depths and forces
/// with doublets about each axis that can be commanded, and comes up again. Everything lies within what the
/// vehicle can do by its layout.
[[nodiscard]] std::vector<Leg> drawn_legs(const Plan& layout, double duration_s, Rng& dice);

}  // namespace navcal::reference::thrusters
