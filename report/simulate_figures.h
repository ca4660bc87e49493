// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/simulate_history.h"
#include "report/html_page.h"
#include "sim/geodesy.h"

namespace navcal::report {

/// Where the vehicle went, and how it moved; with what the instruments said of it.
[[nodiscard]] std::vector<Figure> motion_figures(const analysis::SimulatedSeries& series,
                                                 const sim::Origin& origin);
/// What instruments said that is no motion itself: rates, forces, field, tilt, shaft, current, temperature.
[[nodiscard]] std::vector<Figure> instrument_figures(const analysis::SimulatedSeries& series);

}  // namespace navcal::report
