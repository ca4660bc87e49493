// SPDX-License-Identifier: Apache-2.0
#include "instruments/clock_state.h"

#include <fmt/format.h>

#include <cmath>

#include "base/enum_name.h"

namespace navcal::instruments {

std::string_view name_of(ClockNews news) {
  return base::enum_name<ClockNews::regular>(
      news, {"clock.rate", "clock.rate", "clock.irregular", "clock.bursts", "clock.regular"});
}

std::string words_for(ClockNews news, double nominal_rate_Hz, const ClockState& state) {
  const double rate_Hz = 1 / state.period_s;
  const double percent = 100 * (rate_Hz / nominal_rate_Hz - 1);
  switch (news) {
    case ClockNews::rate:
      return fmt::format("{:.4g} frames a second, {:.2f} % {} than the {:g} that are configured (rate_Hz)",
                         rate_Hz, std::abs(percent), percent < 0 ? "fewer" : "more", nominal_rate_Hz);
    case ClockNews::rate_right: return fmt::format("{:.4g} frames a second again, as configured", rate_Hz);
    case ClockNews::irregular:
      return fmt::format(
          "frames at uneven intervals, where {:g} a second are configured: each is stamped by its own arrival",
          nominal_rate_Hz);
    case ClockNews::bursts:
      return fmt::format("frames come several at a time, {:.4g} a second in the mean: stamped at even intervals",
                         rate_Hz);
    case ClockNews::regular: return fmt::format("frames at even intervals, {:.4g} a second", rate_Hz);
  }
  return {};
}

}  // namespace navcal::instruments
