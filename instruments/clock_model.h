#pragma once

#include <cstdint>

namespace navcal::instruments {

/// What the model of a device's own clock says of itself; shown in HEALTH.
struct ClockState {
  bool locked = false;         ///< enough was seen to stamp by the model rather than by arrival
  double period_s = 0;         ///< estimated time between frames
  double skew_ppm = 0;         ///< of the device's clock against ours: positive when its frames come too slowly
  double skew_std_ppm = 0;
  double jitter_s = 0;         ///< mean delay of arrivals behind the envelope
  std::uint64_t resets = 0;    ///< times the model had to begin again
};

}  // namespace navcal::instruments
