// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calib/suite/suite.h"
#include "config/settings.h"
#include "pipeline/earth_field.h"

namespace navcal::pipeline {

/// The ports that serve heading, rates, position, shaft speed and the reference of the heading.
struct CalibratedPorts {
  std::optional<std::uint16_t> compass, imu, gps, motor, reference;
  [[nodiscard]] calib::Instruments instruments() const {
    return {compass.has_value(), imu.has_value(), gps.has_value(), motor.has_value(), reference.has_value()};
  }
};
/// Before anything has come: the best of each kind by the configuration (Sources).
[[nodiscard]] CalibratedPorts calibrated_ports(const config::Settings& settings);

/// The Earth's field for the calibrators, with standard deviations.
[[nodiscard]] calib::LocalField local_field(const EarthField& field);

/// Noise of a reading of the compass that the calibrators reckon with: as [calibration] states it, else that for
/// the reference compass (base::reference) times how much noisier the compass at hand is.
struct ReckonedNoise {
  double heading_rad, field_uT, tilt_rad;
};
[[nodiscard]] ReckonedNoise reckoned_noise(const config::Settings& settings);

/// Configuration of the calibrators, in their units.
[[nodiscard]] calib::SuiteOptions suite_options(const config::Settings& settings, const CalibratedPorts& ports);

}  // namespace navcal::pipeline
