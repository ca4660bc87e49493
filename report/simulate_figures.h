#pragma once

#include <vector>

#include "report/html_page.h"
#include "analysis/simulate_history.h"
#include "sim/geodesy.h"

namespace navcal::cli {

/// Where the vehicle went, and how it moved; with what the instruments said of it.
[[nodiscard]] std::vector<Figure> motion_figures(const SimulatedSeries& series, const sim::Origin& origin);
/// What instruments said that is no motion itself: rates, forces, field, tilt, shaft, current, temperature.
[[nodiscard]] std::vector<Figure> instrument_figures(const SimulatedSeries& series);

}  // namespace navcal::cli
