// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "identify/data/recorded_motion.h"
#include "identify/replay/predicted_readings.h"
#include "identify/replay/replayed_motion.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::identify {

/// A stretch of a recording that is replayed from an estimated state of its own.
struct Window {
  double begin_s = 0;
  std::size_t steps = 0;
  std::vector<WindowReading> readings;  ///< channel after channel, each in order of time

  [[nodiscard]] double end_s() const { return begin_s + ReplayedMotion::kStep_s * static_cast<double>(steps); }
};

/// Windows of `window_s` that follow one another, from a second behind the first reading on (what the actuators
/// did before is not known). A rest of less than half a window is left out.
[[nodiscard]] std::vector<Window> windows_of(const RecordedMotion& motion, double window_s);

/// First guess of the state at the begin of each window: attitude, rates, depth and position by the readings next
/// to it; velocity by a Doppler log, else as the vehicle had it at the end of the window before.
[[nodiscard]] std::vector<StateVector> guessed_states(const RecordedMotion& motion,
                                                      const std::vector<Window>& windows,
                                                      const sim::LayoutVehicle& vehicle,
                                                      const ActuatorTrajectory& actuators);

}  // namespace navcal::identify
