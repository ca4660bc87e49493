// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "analysis/thesis/thesis_results.h"
#include "report/thesis_content.h"

namespace navcal::report {

/// Figures 1.1, 1.2, 3.1 to 3.11 and 4.1 to 4.12, in this order.
[[nodiscard]] std::vector<ThesisFigure> thesis_figures(const analysis::ThesisResults& results);

/// Figures 3.1 to 3.11.
[[nodiscard]] std::vector<ThesisFigure> thesis_turn_figures(const analysis::ThesisResults& results);
/// Figures 4.1 to 4.6.
[[nodiscard]] std::vector<ThesisFigure> thesis_compass_figures(const analysis::ThesisResults& results);
/// Figures 4.7 to 4.12.
[[nodiscard]] std::vector<ThesisFigure> thesis_field_figures(const analysis::ThesisResults& results);

/// The trace of a path, with noise or without. Throws std::logic_error where there is none.
template <class Trace>
const Trace& thesis_trace_of(const std::vector<Trace>& traces, int path, bool noisy) {
  for (const Trace& trace : traces) {
    if (trace.path == path && trace.noisy == noisy) return trace;
  }
  throw std::logic_error("no trace of this path");
}

/// Panel of the track, a metre north as long as a metre east.
template <class Trace>
ThesisPanel thesis_track_panel(const Trace& trace) {
  return {"Track", "east, m", "north, m", {{"", SvgPlot::Ink::first, trace.east_m, trace.north_m}}, true};
}

}  // namespace navcal::report
