// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using calib::thesis::PrintedCircle;

constexpr std::array<const char*, 5> kFieldCaptions{
    "Without a distortion the method still leaves 0.08 degrees. The cause is the sampling: the 629 samples of "
    "0:0.01:2 pi are not even, because the last gap is 0.0032 rad. With even samples the same method leaves "
    "0.0002 degrees.",
    "Hard iron shifts the circle and gives one wave of error per turn (axis of the thesis: +-10 degrees). The "
    "residual is again that of the uneven samples, not imprecise computing.",
    "Soft iron flattens the circle and gives two waves per turn (axis of the thesis: +-5 degrees).",
    "Hard and soft iron together (axis of the thesis: +-15 degrees).",
    "The strongest distortion, with noise of 0.1 uT (axes of the thesis: -40 to 30 and +-1.5 degrees). Nearly all "
    "of the residual is the noise of the single samples, with both methods; table 4.2 has the error of the "
    "calibrations alone."};

ThesisFigure field_figure(std::size_t row, const analysis::ThesisCircleTrace& trace) {
  const PrintedCircle& printed = calib::thesis::kTable4_2.at(row);
  const std::string title = fmt::format(
      "Magnetometer: shift {:.0f} and {:.0f} uT, eccentricity {:.1f}, axis {:.0f} degrees{}", printed.shift_x_uT,
      printed.shift_y_uT, printed.eccentricity, printed.axis_deg, printed.noise ? ", with noise" : "");
  return {std::string(printed.figure),
          title,
          kFieldCaptions.at(row),
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
  return figures;
}

}  // namespace navcal::report
