// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using calib::thesis::PrintedCircle;

ThesisFigure field_figure(std::size_t row, const analysis::ThesisCircleTrace& trace) {
  const PrintedCircle& printed = calib::thesis::kTable4_2.at(row);
  const std::string title = fmt::format(
      "Magnetometer: shift {:.0f} and {:.0f} uT, eccentricity {:.1f}, axis {:.0f} degrees{}", printed.shift_x_uT,
      printed.shift_y_uT, printed.eccentricity, printed.axis_deg, printed.noise ? ", with noise" : "");
  return {std::string(printed.figure),
          title,
          {{"Horizontal field",
            "starboard, uT",
            "forward, uT",
            {{"measured", Ink::second, trace.raw_y_uT, trace.raw_x_uT},
             {"calibrated", Ink::first, trace.thesis_y_uT, trace.thesis_x_uT}},
            true},
           {"Error of the raw heading",
            "heading, degrees",
            "degrees",
            {{"", Ink::second, trace.heading_deg, trace.raw_error_deg}}},
           {"Residual of each sample",
            "heading, degrees",
            "degrees",
            {{"method of the thesis", Ink::second, trace.heading_deg, trace.thesis_error_deg},
             {"navcal", Ink::first, trace.heading_deg, trace.navcal_error_deg}}}}};
}

}  // namespace

std::vector<ThesisFigure> thesis_field_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{thesis_hard_iron_figure()};
  for (std::size_t row = 0; row < results.circle_traces.size(); ++row)
    figures.push_back(field_figure(row, results.circle_traces.at(row)));
  return figures;
}

std::vector<ThesisFigure> thesis_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures;
  for (const auto& part : {thesis_model_figures(results), thesis_turn_figures(results),
                           thesis_compass_figures(results), thesis_field_figures(results)})
    figures.insert(figures.end(), part.begin(), part.end());
  for (ThesisFigure& figure : figures) {
    if (figure.caption.empty()) figure.caption = thesis_caption(figure.id);
  }
  return figures;
}

}  // namespace navcal::report
