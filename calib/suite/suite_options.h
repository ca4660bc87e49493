// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/reference_instruments.h"
#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/suite/gate.h"

namespace navcal::calib {

/// The Earth's field where the vehicle is.
struct LocalField {
  double declination_rad = 0;       ///< positive east
  std::optional<KnownField> known;  ///< size and dip
};

/// Description of vehicle, instruments and place for the suite.
struct SuiteOptions {
  GateOptions gate;
  bool automatic = true;  ///< estimates come into force by themselves
  double margin = 0.1;    ///< relative improvement on held-out readings that is required
  double heading_noise_rad = base::reference::kReckonedHeadingNoise_rad;
  double rate_noise_rad_sqrt_s = 0.0004;  ///< density: of a reading times the root of its period
  double bias_walk_rad_s_sqrt_s = 3.5e-4;
  double field_noise_uT = base::reference::kReckonedFieldNoise_uT;
  double tilt_noise_rad = base::reference::kReckonedTiltNoise_rad;
  double tilt_lag_s = base::reference::kTiltLag_s;
  LocalField local_field;
  double position_noise_m = base::reference::kPositionNoise_m;
  double velocity_noise_m_s = base::reference::kVelocityNoise_m_s;
  double current_m_s = 0.15;
  double advance_m = base::reference::kAdvance_m;  ///< per revolution of the shaft; 0: not known
};

}  // namespace navcal::calib
