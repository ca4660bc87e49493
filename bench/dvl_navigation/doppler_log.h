// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/samples.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::bench {

/// What a DVL of this run makes of the truth. Errors that stay the same all along are drawn once.
struct DopplerLogOptions {
  bool through_water = false;
  double noise_m_s = 0.02;  ///< each axis, one standard deviation; it is stated as it is
  double scale_error = 0.005, alignment_error_rad = 0.5 * 0.017453292519943295;  ///< one standard deviation
  double dropped = 0.05;  ///< share of the measurements without bottom lock, single ones
  double bad = 0.01;      ///< share of the measurements that are up to 3 m/s off
  double lost_s = 0;      ///< without bottom lock in every `lost_each_s`
  double lost_each_s = 180;
};

/// A Doppler log at the vehicle's origin, five measurements a second.
class DopplerLog {
 public:
  static constexpr std::int64_t kPeriod_ns = 200'000'000;
  static constexpr std::int64_t kLatency_ns = 120'000'000;

  DopplerLog(const DopplerLogOptions& options, std::uint64_t seed);
  /// `time_s` since the begin of the mission.
  [[nodiscard]] instruments::DvlSample measure(const sim::State& state, double time_s);

 private:
  [[nodiscard]] instruments::Vector3 measured_m_s(const sim::State& state, bool over_bottom);

  DopplerLogOptions options_;
  sim::Noise noise_;
  double scale_, yaw_rad_;
};

}  // namespace navcal::bench
