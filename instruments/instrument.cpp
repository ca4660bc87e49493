// SPDX-License-Identifier: Apache-2.0
#include "instruments/instrument.h"

#include "instruments/imu_card.h"
#include "instruments/motor_card.h"
#include "instruments/nmea_device.h"
#include "instruments/oncore_receiver.h"
#include "instruments/tcm2_compass.h"

namespace navcal::instruments {

std::unique_ptr<Instrument> make_instrument(const config::PortSettings& settings) {
  using protocols::Protocol;
  switch (settings.protocol) {
    case Protocol::tcm2:
      return std::make_unique<Tcm2Compass>(settings.compass);
    case Protocol::imu_card:
      return std::make_unique<ImuCard>(settings.imu_card);
    case Protocol::oncore:
      return std::make_unique<OncoreReceiver>(settings);
    case Protocol::motor_card:
      return std::make_unique<MotorCard>();
    case Protocol::nmea:
      break;
  }
  return std::make_unique<NmeaDevice>(settings);
}

}  // namespace navcal::instruments
