// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/simulate_history.h"
#include "report/html_page.h"
#include "sim/geodesy.h"

namespace navcal::report {

/// Track and motion of the vehicle, with the output of the instruments.
[[nodiscard]] std::vector<Figure> motion_figures(const analysis::SimulatedSeries& series,
                                                 const sim::Origin& origin);
/// Instrument outputs that are no motion: rates, forces, field, tilt, shaft, current, temperature.
[[nodiscard]] std::vector<Figure> instrument_figures(const analysis::SimulatedSeries& series);

}  // namespace navcal::report
