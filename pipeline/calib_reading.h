// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calib/readings.h"
#include "instruments/samples.h"

namespace navcal::pipeline {

/// A sample as the calibrators take it; `time_s` from an origin of the caller's choice. True headings are left
/// out, because calibrators learn magnetic ones. A sample without a magnetic heading gets that of its own field,
/// levelled by its own tilt.
[[nodiscard]] calib::CompassReading calib_reading(const instruments::CompassSample& compass,
                                                  const instruments::Stamp& stamp, double time_s);
/// nullopt without rates.
[[nodiscard]] std::optional<calib::RateReading> calib_reading(const instruments::ImuSample& imu,
                                                              const instruments::Stamp& stamp, double time_s);

/// A true heading as a reference; nullopt without one, or without its standard error.
[[nodiscard]] std::optional<calib::ReferenceReading> reference_reading(const instruments::CompassSample& compass,
                                                                       const instruments::Stamp& stamp,
                                                                       double time_s);

}  // namespace navcal::pipeline
