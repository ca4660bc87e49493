// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "validation/reference/effects.h"
#include "validation/reference/instrument.h"
#include "validation/reference/parameter_deviations.h"
#include "validation/reference/run.h"

namespace navcal::reference::testing {

/// Whole seconds: the receiver's are the world's.
inline constexpr std::int64_t kStart_ns = 1'764'000'000'000'000'000;  // 2025-11-24 16:00:00

/// Departures by one effect with these values.
ParameterDeviations with(const std::string& name, const std::map<std::string, double, std::less<>>& parameters);

/// A vehicle that is swung about: turns to both sides, nose up and down, shaft fast and slow, at some metres'
/// depth.
World swung(double duration_s, const VehicleDeviations& deviations = {});
/// One that turns where the antenna is never under water.
World near_surface(double duration_s);

/// Without noise, of clocks that are right, read at once.
Fitting exact();

// Instruments carried along such a world, decoded. `time_s`: of the measurement.
struct CardSample {
  double time_s = 0;
  std::array<double, 8> values{};  ///< rad/s A-x, A-z, B-y, B-z; m/s2 x, y, z; m
};
struct CompassSample {
  double time_s = 0;
  double heading_rad = 0, pitch_rad = 0, roll_rad = 0;
  Vector3 field_uT = Vector3::Zero();
  double temperature_C = 0;
};
struct FixSample {
  double time_s = 0;
  bool fixed = false;
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();  ///< north, east of the anchorage
  Eigen::Vector2d velocity_m_s = Eigen::Vector2d::Zero();
};
std::vector<CardSample> card_along(const World& world, const CardDeviations& deviations,
                                   const Fitting& fitting = exact());
std::vector<CompassSample> compass_along(const World& world, const CompassDeviations& deviations,
                                         const Fitting& fitting = exact());
std::vector<FixSample> receiver_along(const World& world, const GpsDeviations& deviations,
                                      const Fitting& fitting = exact());

}  // namespace navcal::reference::testing
