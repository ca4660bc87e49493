// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/dvl_navigation/doppler_log.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/host_line.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::bench {

/// One simulated mission with errors drawn for it, and the bytes of its instruments. There are fixes in the first
/// minute alone, so that everything after it is reckoned.
class ReckoningRun {
 public:
  static constexpr double kFixes_s = 60, kDuration_s = 900;

  struct Errors {
    double current_m_s = 0.15;  ///< each axis, one standard deviation
    double heading_error_rad = 0;
    double speed_error = 0.05;  ///< of the speed that the shaft makes, relative
  };
  ReckoningRun(const std::string& mission, const Errors& errors, std::uint64_t seed);

  struct Outcome {
    double per_100_m = 0;   ///< rms of the error over the way since the last fix, where it is 50 m or more; m
    double way_m = 0;       ///< run since the last fix, over ground
    double error_m = 0;     ///< at the end
    double normalised = 0;  ///< mean square of the error over the stated one at the end, of north and east
  };
  /// The mission as the daemon's pipeline reckons it, with this DVL or without one.
  [[nodiscard]] Outcome reckon(const std::optional<DopplerLogOptions>& dvl) const;

 private:
  Errors errors_;
  std::uint64_t seed_;
  std::unique_ptr<sim::EffectSet> effects_;
  std::unique_ptr<sim::SimulatedMotion> motion_;
  std::vector<sim::LineRead> reads_;
};

}  // namespace navcal::bench
