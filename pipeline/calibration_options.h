// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calib/suite/suite.h"
#include "config/settings.h"
#include "pipeline/earth_field.h"

namespace navcal::pipeline {

/// The ports that serve heading, rates, position and shaft speed.
struct CalibratedPorts {
  std::optional<std::uint16_t> compass, imu, gps, motor;
  [[nodiscard]] calib::Instruments instruments() const {
    return {compass.has_value(), imu.has_value(), gps.has_value(), motor.has_value()};
  }
};
/// Before anything has come: the best of each kind by the configuration (Sources).
[[nodiscard]] CalibratedPorts calibrated_ports(const config::Settings& settings);

/// The Earth's field for the calibrators, with standard deviations.
[[nodiscard]] calib::LocalField local_field(const EarthField& field);

/// Configuration of the calibrators, in their units.
[[nodiscard]] calib::SuiteOptions suite_options(const config::Settings& settings, const CalibratedPorts& ports);

}  // namespace navcal::pipeline
