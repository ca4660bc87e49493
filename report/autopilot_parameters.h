// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calib/suite/report.h"

namespace navcal::report {

/// Content of a parameter file with which the compass `unit` (1 to 3) of an autopilot corrects its field as these
/// estimates do. Of ArduPilot, in mGauss (.param: lines "NAME,VALUE"; AP_Compass_Backend::correct_field):
///   field = D (measured + OFS) SCALE + MOT current
/// Of PX4, in gauss (.params: the columns of QGroundControl; calibration::Magnetometer::Correct), for a compass
/// whose axes are the vehicle's:
///   field = D (measured + COMP current / 1000 - OFF)
/// The values are absolute, for fields without the autopilot's own calibration. What the estimate does not
/// determine is left out, as is the motor's field where it was not accepted. Throws std::invalid_argument, which
/// says why, when the estimate of hard and soft iron was not accepted.
[[nodiscard]] std::string autopilot_parameters(const calib::Report& report, int unit, bool is_px4);

}  // namespace navcal::report
