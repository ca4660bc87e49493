// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "instruments/instrument.h"
#include "instruments/nmea_device.h"
#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"

namespace navcal::instruments {

/// Motorola Oncore: positions, satellites in view, leap seconds. A receiver set to NMEA is read as NMEA.
class OncoreReceiver : public Instrument {
 public:
  explicit OncoreReceiver(const config::PortSettings& settings);
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  Verdict read_position(const protocols::oncore::Position& position, Receiver& receiver);
  void read_visible(const protocols::oncore::VisibleSatellites& visible, Receiver& receiver) const;

  config::GpsSettings settings_;
  protocols::Date pivot_;
  bool leap_known_ = false;
  std::array<protocols::oncore::Channel, 12>
      channels_{};  ///< of the newest position: strengths for the satellites
  NmeaDevice nmea_;
};

}  // namespace navcal::instruments
