#pragma once

#include <string>

#include "calib/suite/report.h"

namespace navcal::cli {

/// The answer of `navcal calibrate` for people, in lines of a terminal.
[[nodiscard]] std::string calibrate_text(const calib::Report& report, double duration_s);

}  // namespace navcal::cli
