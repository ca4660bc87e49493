// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/angles.h"
#include "calib/thesis/distorted_field.h"
#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using calib::thesis::PrintedCircle;

constexpr std::array<const char*, 5> kFieldCaptions{
    "Without a distortion the method still leaves 0.08 degrees. The cause is the sampling: the 629 samples of "
    "0:0.01:2 pi are not even, because the last gap is 0.0032 rad. With even samples the same method leaves "
    "0.0002 "
    "degrees.",
    "Hard iron shifts the circle and gives one wave of error per turn (axis of the thesis: +-10 degrees). The "
    "residual is again that of the uneven samples, not imprecise computing.",
    "Soft iron flattens the circle and gives two waves per turn (axis of the thesis: +-5 degrees).",
    "Hard and soft iron together (axis of the thesis: +-15 degrees).",
    "The strongest distortion, with noise of 0.1 uT (axes of the thesis: -40 to 30 and +-1.5 degrees). Nearly all "
    "of "
    "the residual is the noise of the single samples, with both methods; table 4.2 has the error of the "
    "calibrations "
    "alone."};

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

ThesisCurve ellipse_curve(const char* name, Ink ink, const calib::EllipseShape& shape) {
  ThesisCurve curve{name, ink, {}, {}};
  for (int heading_deg = 0; heading_deg <= 360; heading_deg += 2) {
    const Eigen::Vector2d field = shape.at(heading_deg * base::kRadiansPerDegree);
    curve.x.push_back(field.y());
    curve.y.push_back(field.x());
  }
  return curve;
}

/// Figure 4.7: what the method measures of an ellipse.
ThesisFigure ellipse_figure() {
  const calib::thesis::FieldDistortion distortion{{6, 8}, 0.8, 30};
  const calib::EllipseShape shape = calib::thesis::distorted_circle(distortion);
  const double axis_rad = distortion.axis_deg * base::kRadiansPerDegree;
  const Eigen::Vector2d half = calib::thesis::kCircle_uT * Eigen::Vector2d(std::cos(axis_rad), std::sin(axis_rad));
  const double minor = std::sqrt(1 - distortion.eccentricity * distortion.eccentricity);
  const Eigen::Vector2d across = minor * Eigen::Vector2d(-half.y(), half.x());
  const Eigen::Vector2d left = shape.centre_uT - across, right = shape.centre_uT + across;
  const Eigen::Vector2d begin = shape.centre_uT - half, end = shape.centre_uT + half;
  return {
      "4.7",
      "What the calibration of the magnetometer finds",
      "The mean of the samples is the centre (4.12), the second moments give the major axis (4.14), the largest "
      "values along both axes their ratio (4.17). Shown: shift 6 and 8 uT, eccentricity 0.8, axis at 30 degrees. "
      "What the thesis draws in this figure is not on record; this is our drawing of its equations.",
      {{"Horizontal field",
        "starboard, uT",
        "forward, uT",
        {ellipse_curve("measured", Ink::second, shape),
         ellipse_curve("calibrated", Ink::first, calib::thesis::distorted_circle({})),
         {"major axis", Ink::fit, {begin.y(), end.y()}, {begin.x(), end.x()}},
         {"minor axis", Ink::third, {left.y(), right.y()}, {left.x(), right.x()}}},
        true}}};
}

/// Nothing is on record of these figures that could be computed.
ThesisFigure picture(const char* id) {
  return {
      id,
      "A picture without data",
      "Figures 1.1 and 1.2 belong to the introduction. Nothing that could be computed is on record of them, so "
      "nothing is drawn here.",
      {}};
}

}  // namespace

std::vector<ThesisFigure> thesis_field_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{ellipse_figure()};
  for (std::size_t row = 0; row < results.circle_traces.size(); ++row)
    figures.push_back(field_figure(row, results.circle_traces.at(row)));
  return figures;
}

std::vector<ThesisFigure> thesis_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{picture("1.1"), picture("1.2")};
  for (const auto& part :
       {thesis_turn_figures(results), thesis_compass_figures(results), thesis_field_figures(results)})
    figures.insert(figures.end(), part.begin(), part.end());
  return figures;
}

}  // namespace navcal::report
