// SPDX-License-Identifier: Apache-2.0
#include "pipeline/navigation.h"

#include <fmt/format.h>

#include "base/enum_name.h"

namespace navcal::pipeline {
namespace {

/// Below it a share of the distance means nothing.
constexpr double kLeastDistance_m = 10;

}  // namespace

std::string_view name_of(PositionSource source) {
  return base::enum_name<PositionSource::reckoned>(source, {"none", "fixes", "reckoned"});
}

std::string_view name_of(nav::SpeedSource source) {
  return base::enum_name<nav::SpeedSource::bottom>(source, {"", "shaft", "water", "dvl"});
}

std::string words_for_outage(const NavigationSample& sample) {
  if (!sample.outage) return {};
  const auto& outage = *sample.outage;
  std::string words = fmt::format("{:.0f} s and {:.0f} m without a fix ended {:.1f} m off", outage.duration_s,
                                  outage.distance_m, outage.error_m);
  if (outage.distance_m >= kLeastDistance_m)
    words += fmt::format(": {:.1f} m per 100 m", 100 * outage.error_m / outage.distance_m);
  if (sample.calibration.number != 0 && sample.outage_error_uncalibrated_m)
    words += fmt::format("; without calibrations {:.1f} m off", *sample.outage_error_uncalibrated_m);
  return words;
}

std::vector<NavigationEvent> events_of(const NavigationSample& sample) {
  std::vector<NavigationEvent> events;
  if (sample.outage) events.push_back({"info", "navigation.fix", words_for_outage(sample)});
  if (sample.surfacing) events.push_back({"info", "surfacing", words_for(*sample.surfacing)});
  if (sample.advice && sample.surface_news != SurfaceNews::none)
    events.push_back({"warning", "surface.advice", words_for(*sample.advice, sample.max_error_m)});
  return events;
}

}  // namespace navcal::pipeline
