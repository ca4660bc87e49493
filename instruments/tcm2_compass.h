// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// PNI TCM2: data words, and its heading as NMEA. What an error code voids is absent from the sample: heading and
/// tilt with the inclinometer out of range (E002), heading and field with the magnetometer (E004), nothing with
/// distortion near (E001).
class Tcm2Compass : public Instrument {
 public:
  explicit Tcm2Compass(const config::CompassSettings& settings) : settings_(settings) {}
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  config::CompassSettings settings_;
};

}  // namespace navcal::instruments
