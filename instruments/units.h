// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "base/angles.h"
#include "base/gravity.h"
#include "config/settings.h"

namespace navcal::instruments {

using base::kGravity_m_s2;

[[nodiscard]] constexpr double radians_of(double angle, config::AngleUnit unit) {
  switch (unit) {
    case config::AngleUnit::deg: return angle * base::kRadiansPerDegree;
    case config::AngleUnit::mils: return angle * (2 * std::numbers::pi / 6400);
    case config::AngleUnit::counts16: return angle * (2 * std::numbers::pi / 65536);
  }
  return angle;
}

[[nodiscard]] constexpr double celsius_of(double temperature, config::TemperatureUnit unit) {
  return unit == config::TemperatureUnit::F ? (temperature - 32) / 1.8 : temperature;
}

}  // namespace navcal::instruments
