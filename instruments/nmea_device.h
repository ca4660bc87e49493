// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "instruments/instrument.h"
#include "instruments/nmea_epoch.h"
#include "instruments/nmea_sky.h"

namespace navcal::instruments {

/// Any NMEA 0183 device: position receivers (one sample an epoch), compasses (one sample a sentence), echo
/// sounders.
class NmeaDevice : public Instrument {
 public:
  explicit NmeaDevice(const config::PortSettings& settings);
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  Verdict read_position(const protocols::nmea::Sentence& sentence, protocols::nmea::Type type, Receiver& receiver);
  Verdict read_heading(const protocols::nmea::Sentence& sentence, protocols::nmea::Type type,
                       Receiver& receiver) const;
  Verdict read_ptnthtm(const protocols::nmea::Sentence& sentence, Receiver& receiver) const;

  config::CompassSettings compass_;
  NmeaEpoch epoch_;
  NmeaSky sky_;
};

}  // namespace navcal::instruments
