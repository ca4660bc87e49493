// SPDX-License-Identifier: Apache-2.0
#include "instruments/start_up.h"

#include "instruments/start_up_oncore.h"
#include "instruments/start_up_tcm2.h"

namespace navcal::instruments {

std::unique_ptr<StartUp> make_start_up(const config::PortSettings& settings) {
  if (!settings.start_up) return nullptr;
  switch (settings.protocol) {
    case protocols::Protocol::tcm2:
      return std::make_unique<StartUpTcm2>(settings);
    case protocols::Protocol::oncore:
      return std::make_unique<StartUpOncore>();
    case protocols::Protocol::imu_card:
    case protocols::Protocol::motor_card:
    case protocols::Protocol::nmea:
      break;
  }
  return nullptr;
}

}  // namespace navcal::instruments
