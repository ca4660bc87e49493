// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "instruments/clock_state.h"

namespace navcal::instruments {

/// What a frame clock finds that differs from the configuration, or no longer does.
enum class ClockNews : std::uint8_t {
  rate,        ///< the rate is another than configured, or than told before
  rate_right,  ///< it is as configured again
  irregular,   ///< no clock explains the frames
  bursts,      ///< they come several at a time
  regular,     ///< one by one at even intervals again
};

/// Rates that differ from the configured one by less are no news.
inline constexpr double kRateTolerance = 0.005;

/// Name of the event in the log.
[[nodiscard]] std::string_view name_of(ClockNews news);
/// For people. `nominal_rate_Hz`: as configured.
[[nodiscard]] std::string words_for(ClockNews news, double nominal_rate_Hz, const ClockState& state);

}  // namespace navcal::instruments
