// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace navcal::instruments {

/// Source of the times of validity of a stream's frames.
enum class Timing : std::uint8_t {
  arrival,    ///< no rate is configured: by their own arrival
  searching,  ///< too few frames so far: by a line below those that there are
  periodic,   ///< by the model of the device's clock
  bursts,     ///< likewise, and the frames come several at a time
  irregular,  ///< no clock explains them: by their own arrival
  device,     ///< by the times that the device states with its own clock
};

[[nodiscard]] std::string_view name_of(Timing timing);

/// State of the model of a device's own clock; shown in HEALTH.
struct ClockState {
  bool locked = false;  ///< enough was seen to stamp by the model rather than by arrival
  Timing timing = Timing::arrival;
  double period_s = 0;  ///< estimated time between frames
  double skew_ppm = 0;  ///< of the device's clock against ours: positive when its frames come too slowly
  double skew_std_ppm = 0;
  double jitter_s = 0;  ///< mean delay of arrivals behind the envelope
  std::uint64_t resets = 0;
};

/// A time in nanoseconds with one standard deviation.
struct TimeEstimate {
  std::int64_t time_ns = 0;
  std::int64_t std_ns = 0;
};

/// Differences of a stream from its configuration that a frame clock finds, and their end.
enum class ClockNews : std::uint8_t {
  rate,        ///< the rate differs from the configured one, or from the one reported before
  rate_right,  ///< it is as configured again
  irregular,   ///< no clock explains the frames
  bursts,      ///< they come several at a time
  regular,     ///< one by one at even intervals again
};

/// Relative difference from the configured rate below which a rate is not reported.
inline constexpr double kRateTolerance = 0.005;

/// Name of the event in the log.
[[nodiscard]] std::string_view name_of(ClockNews news);
/// Text of the event for people. `nominal_rate_Hz`: as configured.
[[nodiscard]] std::string words_for(ClockNews news, double nominal_rate_Hz, const ClockState& state);

}  // namespace navcal::instruments
