// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "instruments/samples.h"
#include "nav/estimate.h"
#include "pipeline/surface_advice.h"
#include "pipeline/surfacing.h"

namespace navcal::pipeline {

/// Device name of the estimate in reports and log, in the place of an instrument's port name.
inline constexpr std::string_view kNavigationDevice = "navigation";

/// Whence a position is.
enum class PositionSource : std::uint8_t {
  none,      ///< there was no fix yet
  fixes,     ///< the last fix is as young as fixes usually are
  reckoned,  ///< reckoned on from the last one
};

/// "none", "fixes", "reckoned".
[[nodiscard]] std::string_view name_of(PositionSource source);

/// "shaft", "water", "dvl"; empty: the speed is unknown.
[[nodiscard]] std::string_view name_of(nav::SpeedSource source);

/// The estimate of one instant (docs/navigation.md).
struct NavigationSample {
  instruments::Stamp stamp;  ///< validity is that of the estimate, arrival that of the sample that called for it
  instruments::CalibrationName calibration;
  nav::Estimate estimate;  ///< its north and east are of no interest outside: they have an origin of their own
  PositionSource source = PositionSource::none;
  std::optional<double> latitude_rad, longitude_rad;  ///< WGS84
  /// Height of the altimeter above the sea floor, straight down, its standard deviation, and the depth of the
  /// water there; nullopt without an altimeter, and soon after its last reading.
  std::optional<double> altitude_m, altitude_std_m, water_depth_m;
  /// Whether a DVL that is heard measures the velocity over the bottom; nullopt without one.
  std::optional<bool> bottom_lock;
  /// A stretch without fixes that has just ended, and how far off it would have ended without calibrations.
  std::optional<nav::Outage> outage;
  std::optional<double> outage_error_uncalibrated_m;
  std::optional<Surfacing> surfacing;   ///< that has just ended with a fix
  std::optional<SurfaceAdvice> advice;  ///< with a position
  SurfaceNews surface_news = SurfaceNews::none;
  double max_error_m = 0;  ///< bound of the advice; 0: none
};

/// An event of the log.
struct NavigationEvent {
  std::string_view severity, name;
  std::string message;
};
/// Events of an estimate: the end of a stretch without fixes, a surfacing, an advice to surface.
[[nodiscard]] std::vector<NavigationEvent> events_of(const NavigationSample& sample);

/// "83 s and 91 m without a fix ended 2.3 m off: 2.5 m per 100 m; without calibrations 7.9 m off".
[[nodiscard]] std::string words_for_outage(const NavigationSample& sample);

}  // namespace navcal::pipeline
