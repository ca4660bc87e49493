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
/// Whether the calibrators learn from a sample: it has a field or a magnetic heading. A true heading is most often
/// an estimate by the same compass, and NMEA's lines of tilt or rate of turn alone are no readings of a heading.
[[nodiscard]] inline bool is_reading_of_compass(const instruments::CompassSample& compass) {
  return compass.field_body_uT || (compass.heading_rad && !compass.heading_is_true);
}
/// nullopt without rates.
[[nodiscard]] std::optional<calib::RateReading> calib_reading(const instruments::ImuSample& imu,
                                                              const instruments::Stamp& stamp, double time_s);

/// A true heading as a reference; nullopt without one, or without its standard error.
[[nodiscard]] std::optional<calib::ReferenceReading> reference_reading(const instruments::CompassSample& compass,
                                                                       const instruments::Stamp& stamp,
                                                                       double time_s);

}  // namespace navcal::pipeline
