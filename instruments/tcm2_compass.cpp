// SPDX-License-Identifier: Apache-2.0
#include "base/angles.h"
#include "instruments/compass_error.h"
#include "instruments/devices.h"
#include "instruments/units.h"
#include "protocols/tcm2.h"

namespace navcal::instruments {

namespace tcm2 = protocols::tcm2;

/// PNI TCM2: data words, and its heading as NMEA. What an error code voids is absent from the sample: heading and
/// tilt with the inclinometer out of range (E002), heading and field with the magnetometer (E004), nothing with
/// distortion near (E001).
Verdict read_tcm2(const protocols::Frame& frame, const config::PortSettings& settings, Receiver& receiver) {
  CompassSample sample;
  if (frame.id == tcm2::kWord) {
    const auto word = tcm2::decode_word(frame.bytes);
    if (!word) return Verdict::out_of_range;
    const CompassError error(word->error);
    if (!error.tilt_out_of_range) {
      if (word->heading && !error.field_out_of_range)
        sample.heading_rad = radians_of(*word->heading, settings.compass.heading_unit);
      if (word->pitch) sample.pitch_rad = radians_of(*word->pitch, settings.compass.tilt_unit);
      if (word->roll) sample.roll_rad = radians_of(*word->roll, settings.compass.tilt_unit);
    }
    if (!error.field_out_of_range) sample.field_body_uT = word->field();
    if (word->temperature)
      sample.temperature_C = celsius_of(*word->temperature, settings.compass.temperature_unit);
    sample.error = word->error;
  } else if (frame.id == tcm2::kHchdm) {
    const auto heading_deg = tcm2::decode_hchdm(frame.bytes);
    if (!heading_deg) return Verdict::out_of_range;
    sample.heading_rad = *heading_deg * base::kRadiansPerDegree;
  } else {
    return Verdict::ignored;
  }
  hand_over(sample, receiver);
  return Verdict::used;
}

}  // namespace navcal::instruments
