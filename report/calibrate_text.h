// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "calib/suite/report.h"

namespace navcal::report {

/// The answer of `navcal calibrate` as text for a terminal.
[[nodiscard]] std::string calibrate_text(const calib::Report& report, double duration_s);

}  // namespace navcal::report
