// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "validation/reference/card.h"
#include "validation/reference/compass.h"
#include "validation/reference/receiver.h"
#include "validation/reference/run.h"
#include "validation/reference/sink.h"
#include "validation/reference/thrusters/allocator.h"
#include "validation/reference/thrusters/effects.h"
#include "validation/reference/thrusters/outputs.h"
#include "validation/reference/waters.h"

namespace navcal::reference::thrusters {

/// What the pilot is to do from a time on.
struct Leg {
  double from_s = 0;
  double heading_rad = 0;  ///< true
  double depth_m = 0;
  double surge = 0, sway = 0;  ///< shares of the greatest force along these axes
  /// Acceleration along or about each axis, m/s2 or rad/s2: so for 1 s, then the opposite for 1 s, `doublet_s`
  /// after `from_s`.
  Vector6 doublet = Vector6::Zero();
  double doublet_s = 0;
};

/// The vehicle's own autopilot, ten times a second. It knows the layout, and of the motion what compass and
/// card say: roll and pitch by the gyros in short, by the compass's tilt in the long run (2 s). Of each axis that
/// can be commanded, with inertia M of the layout, e the error, x' the rate:
///     heading        N = M66 b (b e - 2 z r)                   b 1.5 rad/s, z 0.9
///     roll, pitch    K, M likewise                             b 2.5 rad/s
///     depth          Z = M33 (b (b d - 2 z w) + 0.05 int d)    b 0.6 rad/s; w from the filtered depth;
///                                                            the integral within 0.3 m only; less weight that
///                                                            buoyancy does not bear
///     where heave cannot be commanded: pitch wanted = -0.6 (d + 0.1 int d), within 35 degrees
class Pilot {
 public:
  /// `variation_rad`: of magnetic north from true north, as its charts have it.
  Pilot(const Plan& plan, double variation_rad);

  static constexpr double kPeriod_s = 0.1;

  /// Whole microseconds for each thruster.
  [[nodiscard]] std::vector<int> steer(const Leg& leg, double time_s, const Compass::Reading& compass,
                                       const Card::Reading& card);
  [[nodiscard]] const Allocator& allocator() const { return allocator_; }

 private:
  [[nodiscard]] double held(std::size_t axis, double error_rad, double rate_rad_s, double pace_rad_s) const;
  void observe_tilt(const Compass::Reading& compass, const Card::Reading& card);
  void steer_depth(const Leg& leg, const Card::Reading& card, Wrench& wanted);

  Allocator allocator_;
  Vector6 inertia_;
  double sinking_N_;  ///< weight less buoyancy, by the layout
  double variation_rad_;
  double roll_rad_ = 0, pitch_rad_ = 0;
  double depth_sum_ = 0;
  std::optional<double> smooth_depth_m_;
  double sinking_m_s_ = 0;
};

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
