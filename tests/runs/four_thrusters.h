// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "runs/run.h"

namespace navcal::runs::test {

/// What a made-up vehicle of four thrusters has; the defaults are nominal.
struct Trait {
  double command_us = 1200, stop_us = 1100, battery_V = 12;
  double weight_share = 0;  ///< net weight added, over the thrust of all four at full command
  double depth_zero_m = 0;  ///< what the depth sensor reads at the surface
  double lost_thrust = 0;   ///< share of the first thruster's thrust
  double ripple_rad_s = 0;  ///< amplitude of a ripple of the yaw rate
  double roll_rest_rad = 0.1, pitch_rest_rad = 0.02, surface_pressure = 605;
  double heave_gain = 1, yaw_gain = 1, clock_s = 50000;
  double seconds = 10, noise = 1;
};

/// One run: simulated heave and yaw, rows at 20 Hz, the thrusters start after 0.3 s. A reality of its own: thrust
/// of each propeller with a lag, linear drag, quadratic drag of the yaw.
[[nodiscard]] Run make_run(const Trait& trait, std::uint32_t seed, const std::string& name = "run");

/// The same as the text of a run file.
[[nodiscard]] std::string run_text(const Run& run);

/// Sessions of nominal runs, which differ from session to session and from run to run.
[[nodiscard]] std::vector<Run> nominal_runs(int sessions, int runs_of_a_session, std::uint32_t seed);

/// Runs of one session that no other has, with a trait.
[[nodiscard]] std::vector<Run> session_of(Trait trait, int runs, std::uint32_t seed);

}  // namespace navcal::runs::test
