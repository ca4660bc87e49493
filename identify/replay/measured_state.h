// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "identify/data/recorded_motion.h"
#include "identify/replay/replayed_motion.h"

namespace navcal::identify {

/// Sets what the readings next to a time measure: position, attitude, rates, and the velocity of a Doppler log.
/// All else stays as it is, but for the lagged tilt, which becomes that of the body.
void measure_state(const RecordedMotion& motion, double time_s, StateVector& state);

}  // namespace navcal::identify
