// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/surfacing_run.h"

namespace navcal::report {

/// A page with the distribution of the time to first fix, that time against the time under water with the model of
/// the receiver, the error of the dead reckoning against the time without fixes, and a table.
[[nodiscard]] std::string surfacings_page(const std::vector<analysis::RecordedSurfacing>& surfacings,
                                          const std::vector<std::string>& files, const config::Settings& settings);

}  // namespace navcal::report
