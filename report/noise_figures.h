// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/noise/noise_run.h"
#include "report/html_page.h"

namespace navcal::report {

/// Allan deviations of channels of one unit in one plot, four at most.
[[nodiscard]] Figure allan_overview(const std::vector<const analysis::RecordedChannel*>& channels);

/// Readings with the parts at rest, Allan deviation with its interval and the fitted terms, spectrum with its
/// lines. A figure that would be empty is left out.
[[nodiscard]] std::vector<Figure> channel_figures(const analysis::RecordedChannel& recorded,
                                                  const analysis::NoiseReport& report);

}  // namespace navcal::report
