// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calib/suite/report.h"

namespace navcal::report {

/// Content of a parameter file (.param: lines "NAME,VALUE") with which the compass `unit` (1 to 3) of ArduPilot
/// corrects its field as these estimates do (AP_Compass_Backend::correct_field):
///   field = D (measured + OFS) SCALE + MOT current
/// The values are absolute, for fields without the autopilot's own calibration. What the estimate does not
/// determine is left out, as is the motor's field where it was not accepted. Throws std::invalid_argument, which
/// says why, when the estimate of hard and soft iron was not accepted.
[[nodiscard]] std::string autopilot_parameters(const calib::Report& report, int unit);

}  // namespace navcal::report
