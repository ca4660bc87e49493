// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>

#include "protocols/tcm2_reply.h"
#include "sim/instruments/tcm2_sensor.h"

namespace navcal::sim {

/// The TCM2's own calibration as far as the host can see it: how well the turns and tilts made so far cover what
/// it needs (ICD section 1). The emulated unit has no iron to correct, so the magnitude is that of its noise.
class Tcm2Score {
 public:
  void clear() { *this = {}; }
  void add(const Tcm2Reading& reading);
  [[nodiscard]] protocols::tcm2::CalibrationScore score() const;

 private:
  static constexpr std::size_t kSectors = 36;
  std::bitset<kSectors> headings_;
  double least_pitch_rad_ = 0, greatest_pitch_rad_ = 0;
  double least_roll_rad_ = 0, greatest_roll_rad_ = 0;
};

}  // namespace navcal::sim
