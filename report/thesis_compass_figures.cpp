// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using analysis::ThesisCompassTrace;

constexpr const char* kCircleLabel = "heading, degrees";

constexpr std::array kCompassFigures{
    PathFigure{"4.2", 2, false,
               "All headings are visited, so least squares finds the curve to about a degree, which is as good as "
               "the thesis's metric can show: with the true coefficients it reads 1.04 degrees."},
    PathFigure{"4.3", 4, false,
               "Half the circle is not visited, and there the curve is extrapolated. Figure and table of the "
               "thesis disagree: the axis of its figure 4.3(d) reaches from -6 to 3 degrees, but its coefficients "
               "of table 4.1 give -3.30 to 1.33 degrees. They come from different runs."},
    PathFigure{"4.4", 7, false,
               "Six turns in a tight circle with 6 degrees of roll: the neglected pitch rate turns the heading "
               "away by 25 degrees, and C and E take it up. navcal uses the exact kinematics."},
    PathFigure{"4.5", 8, false,
               "One slow, even turn: the best path of the thesis, at the floor of its metric. Figure and table "
               "disagree slightly: axis of 4.5(d) +-0.8 degrees, table 4.1 gives -0.85 to 0.90 degrees."},
    PathFigure{"4.6", 8, true,
               "Path 8 with the noise of figure 3.5. Both errors are shown with the self-consistent deviation psi "
               "= psi_m - E(psi_m), which has no floor."}};

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
          figure.caption,
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
