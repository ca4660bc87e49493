// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/noise/noise_run.h"

namespace navcal::report {

/// The page of `navcal noise`: table, Allan deviations of each device, and of each channel its readings with the
/// parts at rest, Allan deviation and spectrum.
[[nodiscard]] std::string noise_page(const analysis::NoiseReport& report);

}  // namespace navcal::report
