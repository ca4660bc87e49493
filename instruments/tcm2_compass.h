#pragma once

#include "instruments/instrument.h"

namespace navcal::instruments {

/// PNI TCM2: data words, and its heading as NMEA. While the device says that its inclinometer is out of range
/// (E002), heading and tilt are void; the field is not.
class Tcm2Compass : public Instrument {
 public:
  explicit Tcm2Compass(const config::CompassSettings& settings) : settings_(settings) {}
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  config::CompassSettings settings_;
};

}  // namespace navcal::instruments
