// SPDX-License-Identifier: Apache-2.0
#include "instruments/compass_calibration.h"

#include "instruments/pni_calibration.h"
#include "instruments/tcm2_calibration.h"

namespace navcal::instruments {

std::unique_ptr<CompassCalibration> make_compass_calibration(const config::PortSettings& settings) {
  if (settings.protocol == protocols::Protocol::tcm2) return std::make_unique<Tcm2Calibration>(settings);
  if (settings.protocol == protocols::Protocol::pni) return std::make_unique<PniCalibration>();
  return nullptr;
}

bool is_compass_calibration(std::string_view name) {
  return name == Tcm2Calibration::kName || name == PniCalibration::kName;
}

}  // namespace navcal::instruments
