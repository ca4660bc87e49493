// SPDX-License-Identifier: Apache-2.0
#include "pipeline/surfacing.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/durations.h"

namespace navcal::pipeline {

std::optional<double> Surfacing::without_fix_s() const {
  if (last_fix_ns == 0) return std::nullopt;
  return base::seconds(first_fix_ns - last_fix_ns);
}

std::optional<double> Surfacing::submerged_s() const {
  if (!dived_ns || !surfaced_ns) return std::nullopt;
  return base::seconds(*surfaced_ns - *dived_ns);
}

std::optional<double> Surfacing::time_to_first_fix_s() const {
  if (!surfaced_ns) return std::nullopt;
  return std::max(0.0, base::seconds(first_fix_ns - *surfaced_ns));
}

std::string words_for(const Surfacing& surfacing) {
  std::string words;
  if (const auto submerged_s = surfacing.submerged_s()) {
    words = fmt::format("{:.0f} s under water, down to {:.1f} m; first fix {:.1f} s after surfacing", *submerged_s,
                        surfacing.deepest_m.value_or(0), *surfacing.time_to_first_fix_s());
  } else if (const auto without_fix_s = surfacing.without_fix_s()) {
    words =
        fmt::format("first fix after {:.0f} s without one; the time of surfacing is not known", *without_fix_s);
  } else {
    words = "first fix; the time of surfacing is not known";
  }
  if (surfacing.tracked) words += fmt::format(", {} satellites", *surfacing.tracked);
  if (surfacing.dop) words += fmt::format(", DOP {:.1f}", *surfacing.dop);
  return words;
}

}  // namespace navcal::pipeline
