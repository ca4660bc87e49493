// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/suite/gate.h"

namespace navcal::calib {

/// The Earth's field where the vehicle is.
struct LocalField {
  double declination_rad = 0;       ///< positive east
  std::optional<KnownField> known;  ///< size and dip
};

/// What the suite must be told of vehicle, instruments and place.
struct SuiteOptions {
  GateOptions gate;
  bool automatic = true;  ///< estimates come into force by themselves
  double margin = 0.1;    ///< by so much must they be better on readings held out, relative
  double heading_noise_rad = 0.0087;
  double rate_noise_rad_sqrt_s = 0.0004;  ///< density: of a reading times the root of its period
  double bias_walk_rad_s_sqrt_s = 3.5e-4;
  double field_noise_uT = 0.2;
  double tilt_lag_s = 0.3;
  LocalField local_field;
  double position_noise_m = 1;
  double velocity_noise_m_s = 0.1;
  double current_m_s = 0.15;
  double advance_m = 0.0872;  ///< per revolution of the shaft; 0: not known
};

}  // namespace navcal::calib
