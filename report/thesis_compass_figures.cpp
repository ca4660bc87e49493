// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using analysis::ThesisCompassTrace;

constexpr const char* kCircleLabel = "heading, degrees";

constexpr std::array<PathFigure, 5> kCompassFigures{
    {{"4.2", 2}, {"4.3", 4}, {"4.4", 7}, {"4.5", 8}, {"4.6", 8, true}}};

ThesisFigure compass_figure(const PathFigure& figure, const ThesisCompassTrace& trace) {
  ThesisPanel error{"Error of the calibrated heading", kCircleLabel, "degrees", {}};
  if (!figure.noisy)
    error.curves.push_back(
        {"true coefficients, metric of the thesis", Ink::fit, trace.circle_deg, trace.perfect_error_deg});
  error.curves.push_back({"least squares", Ink::second, trace.circle_deg, trace.thesis_error_deg});
  error.curves.push_back({"navcal", Ink::first, trace.circle_deg, trace.navcal_error_deg});
  const std::string noise = figure.noisy ? ", with noise" : "";
  return {figure.id,
          "Compass by least squares, path " + std::to_string(figure.path) + noise,
          {thesis_track_panel(trace),
           {"Heading",
            "seconds",
            "degrees",
            {{"compass", Ink::second, trace.time_s, trace.measured_deg},
             {"true", Ink::fit, trace.time_s, trace.heading_deg}}},
           {"Deviation E",
            kCircleLabel,
            "degrees",
            {{"injected", Ink::fit, trace.circle_deg, trace.injected_deg},
             {"least squares", Ink::second, trace.circle_deg, trace.thesis_deg},
             {"navcal", Ink::first, trace.circle_deg, trace.navcal_deg}}},
           std::move(error)}};
}

}  // namespace

std::vector<ThesisFigure> thesis_compass_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{thesis_deviation_figure()};
  for (const PathFigure& figure : kCompassFigures)
    figures.push_back(compass_figure(figure, thesis_trace_of(results.compass_traces, figure.path, figure.noisy)));
  return figures;
}

}  // namespace navcal::report
