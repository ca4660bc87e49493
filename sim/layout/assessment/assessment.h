// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autopilot/controllability.h"
#include "config/layout.h"

namespace navcal::sim {

/// Vehicle at rest with neutral actuators. Trim and stability are those of the couple of weight and buoyancy.
struct Statics {
  double mass_kg = 0;
  double displaced_kg = 0;    ///< buoyancy over g
  double net_buoyancy_N = 0;  ///< positive upwards
  double roll_rad = 0, pitch_rad = 0;
  double metacentric_height_m =
      0;  ///< the centre of gravity below that of buoyancy when upright; positive: stable
  std::optional<double> roll_period_s, pitch_period_s;     ///< undamped; nothing where it is unstable
  double roll_damping_ratio = 0, pitch_damping_ratio = 0;  ///< of the linear damping at rest
};

/// Steady speed along one axis, level, with all other motion held. No speed: not below 30 m/s.
struct SteadySpeed {
  std::string what;                 ///< "ahead, 50 % command", "neutral", "ballast at -2 N"
  double force_N = 0;               ///< that drives it, at rest
  std::optional<double> speed_m_s;  ///< ahead, or downwards
};

/// Steady motion at the end of a simulation in six degrees of freedom.
struct SteadyMotion {
  std::string what;
  bool is_steady = false;
  std::string failure;  ///< why the simulation ended early; empty: it did not
  double speed_m_s = 0, surge_m_s = 0;
  double roll_rad = 0, pitch_rad = 0;
  double roll_rate_rad_s = 0;
  double turn_rad_s = 0;           ///< rate of heading
  std::optional<double> radius_m;  ///< speed over turn; nothing where it hardly turns
  double path_rad = 0;             ///< angle of the path above the horizon
  double attack_rad = 0;           ///< atan2(w, u)
};

/// Something that no vehicle should have, with the number that shows it.
struct Oddity {
  std::string key;  ///< of the layout's file, "body.inertia_kg_m2"
  std::string message;
};

/// What a layout amounts to (navcal vehicle check).
struct Assessment {
  std::string cannot_simulate;  ///< why; empty: it can be
  Statics statics;
  std::vector<SteadySpeed> ahead, downwards;
  std::vector<SteadyMotion> motions;  ///< straight ahead, turning, gliding: what the layout can do
  autopilot::Controllability at_rest, under_way;
  double under_way_m_s = 0;  ///< speed of under_way
  std::vector<Oddity> odd;
};

/// Takes about a second of computing.
[[nodiscard]] Assessment assess(const config::Layout& layout);

}  // namespace navcal::sim
