// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "instruments/clock_state.h"

namespace navcal::instruments {

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
