#pragma once

#include <string>
#include <vector>

#include "cli/simulate_history.h"

namespace navcal::cli {

struct SimulatedFigure {
  std::string title, svg_html, caption;
};

/// Where the vehicle went, and how it moved; with what the instruments said of it.
[[nodiscard]] std::vector<SimulatedFigure> motion_figures(const SimulatedSeries& series);
/// What instruments said that is no motion itself: rates, forces, field, tilt, shaft, current, temperature.
[[nodiscard]] std::vector<SimulatedFigure> instrument_figures(const SimulatedSeries& series);

}  // namespace navcal::cli
