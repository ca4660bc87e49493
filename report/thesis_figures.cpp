// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "calib/thesis/printed_tables.h"
#include "report/thesis_content.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;
using analysis::ThesisTurnTrace;
using calib::thesis::kTrueBias_rad_s;
using calib::thesis::kTrueScale;

constexpr const char* kSeconds = "seconds";

/// A figure of the thesis that shows a path.
struct PathFigure {
  const char* id;
  int path;
  bool noisy = false;
};

constexpr std::array<PathFigure, 5> kLeastSquaresFigures{
    {{"3.1", 2}, {"3.2", 3}, {"3.3", 4}, {"3.4", 7}, {"3.5", 3, true}}};
constexpr std::array<PathFigure, 5> kIdentifierFigures{
    {{"3.6", 2}, {"3.7", 3}, {"3.8", 4}, {"3.9", 7}, {"3.10", 3, true}}};

/// The trace of a path, with noise or without. Throws std::logic_error where there is none.
template <class Trace>
const Trace& trace_of_path(const std::vector<Trace>& traces, int path, bool noisy) {
  for (const Trace& trace : traces) {
    if (trace.path == path && trace.noisy == noisy) return trace;
  }
  throw std::logic_error("no trace of this path");
}

/// Panel of the track, a metre north as long as a metre east.
template <class Trace>
ThesisPanel track_panel(const Trace& trace) {
  return {"Track", "east, m", "north, m", {{"", SvgPlot::Ink::first, trace.east_m, trace.north_m}}, true};
}

ThesisPanel rate_panel(const ThesisTurnTrace& trace) {
  return {"Heading rate",
          kSeconds,
          "rad/s",
          {{"gyro", Ink::second, trace.time_s, trace.measured_rate_rad_s},
           {"true", Ink::fit, trace.time_s, trace.rate_rad_s}}};
}

ThesisPanel rate_error_panel(const ThesisTurnTrace& trace, const char* method,
                             const analysis::ThesisRateErrors& errors) {
  return {"Error of the calibrated rate",
          kSeconds,
          "rad/s",
          {{method, Ink::second, trace.time_s, errors.rate_rad_s},
           {"navcal", Ink::first, trace.time_s, trace.navcal.rate_rad_s}}};
}

ThesisPanel heading_error_panel(const ThesisTurnTrace& trace, const char* method,
                                const analysis::ThesisRateErrors& errors) {
  return {"Error of the integrated heading",
          kSeconds,
          "rad",
          {{method, Ink::second, trace.time_s, errors.heading_rad},
           {"navcal", Ink::first, trace.time_s, trace.navcal.heading_rad}}};
}

std::string title_of(const char* method, const PathFigure& figure) {
  return std::string(method) + ", path " + std::to_string(figure.path) + (figure.noisy ? ", with noise" : "");
}

ThesisFigure least_squares_figure(const PathFigure& figure, const ThesisTurnTrace& trace) {
  return {figure.id,
          title_of("Gyro by least squares", figure),
          {track_panel(trace),
           {"Heading", kSeconds, "rad", {{"true", Ink::fit, trace.time_s, trace.heading_rad}}},
           rate_panel(trace),
           {"Roll", kSeconds, "degrees", {{"true", Ink::fit, trace.time_s, trace.roll_deg}}},
           rate_error_panel(trace, "least squares", trace.least_squares),
           heading_error_panel(trace, "least squares", trace.least_squares)}};
}

/// A level line at the true value.
ThesisCurve true_value(const ThesisTurnTrace& trace, double value) {
  return {"true", Ink::fit, {trace.time_s.front(), trace.time_s.back()}, {value, value}};
}

/// An estimate of navcal and of the identifier, beside the true value.
ThesisPanel estimate_panel(const ThesisTurnTrace& trace, const char* title, const char* unit, double truth,
                           const std::vector<double>& navcal, const std::vector<double>& identifier) {
  // The filter's first estimates may be far off.
  std::vector<double> shown = identifier;
  shown.push_back(truth);
  return {title,
          kSeconds,
          unit,
          {true_value(trace, truth),
           {"navcal", Ink::first, trace.time_s, navcal},
           {"identifier", Ink::second, trace.time_s, identifier}},
          false,
          whole_range_of(shown)};
}

ThesisPanel scale_panel(const ThesisTurnTrace& trace) {
  return estimate_panel(trace, "Scale abar", "", kTrueScale, trace.navcal_scale, trace.adaptive_scale);
}

ThesisPanel bias_panel(const ThesisTurnTrace& trace) {
  return estimate_panel(trace, "Bias bbar", "rad/s", kTrueBias_rad_s, trace.navcal_bias_rad_s,
                        trace.adaptive_bias_rad_s);
}

ThesisPanel state_error_panel(const ThesisTurnTrace& trace) {
  return {"Error of the identifier's heading",
          kSeconds,
          "rad",
          {{"identifier", Ink::second, trace.time_s, trace.adaptive_state_error_rad}}};
}

ThesisFigure identifier_figure(const PathFigure& figure, const ThesisTurnTrace& trace) {
  return {figure.id,
          title_of("Adaptive identifier", figure),
          {scale_panel(trace), bias_panel(trace), rate_panel(trace), state_error_panel(trace),
           rate_error_panel(trace, "identifier", trace.adaptive),
           heading_error_panel(trace, "identifier", trace.adaptive)}};
}

/// abar omega_m + bbar = omega at the last rate of a path, from one scale to another.
ThesisCurve identified_line(const ThesisTurnTrace& trace, double least, double most) {
  const double measured = trace.measured_rate_rad_s.back();
  const double true_rate = kTrueScale * measured + kTrueBias_rad_s;
  return {"all that a constant rate tells",
          Ink::fit,
          {least, most},
          {true_rate - least * measured, true_rate - most * measured}};
}

/// Both estimates against each other on the paths of constant rate.
ThesisPanel plane_panel(const analysis::ThesisResults& results) {
  constexpr std::array kConstantRate{1, 7, 8};
  constexpr std::array kInks{Ink::first, Ink::second, Ink::third};
  ThesisPanel plane{"Both estimates, paths of constant rate", "scale abar", "bias bbar, rad/s", {}};
  for (std::size_t i = 0; i < kConstantRate.size(); ++i) {
    const ThesisTurnTrace& trace = trace_of_path(results.turn_traces, kConstantRate.at(i), false);
    ThesisCurve line = identified_line(trace, -0.8, kTrueScale);
    if (i > 0) line.name.clear();
    plane.curves.push_back(std::move(line));
    plane.curves.push_back({"path " + std::to_string(kConstantRate.at(i)), kInks.at(i), trace.adaptive_scale,
                            trace.adaptive_bias_rad_s});
  }
  plane.curves.push_back({"true", Ink::fit, {kTrueScale}, {kTrueBias_rad_s}, true});
  return plane;
}

ThesisFigure convergence_figure(const analysis::ThesisResults& results) {
  const ThesisTurnTrace& trace = trace_of_path(results.turn_traces, 7, false);
  return {"3.11",
          "Convergence of the adaptive identifier, path 7",
          {state_error_panel(trace), scale_panel(trace), bias_panel(trace), plane_panel(results)}};
}

/// Figures 3.1 to 3.11.
std::vector<ThesisFigure> turn_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures;
  for (const PathFigure& figure : kLeastSquaresFigures)
    figures.push_back(least_squares_figure(figure, trace_of_path(results.turn_traces, figure.path, figure.noisy)));
  for (const PathFigure& figure : kIdentifierFigures)
    figures.push_back(identifier_figure(figure, trace_of_path(results.turn_traces, figure.path, figure.noisy)));
  figures.push_back(convergence_figure(results));
  return figures;
}

constexpr const char* kCircleLabel = "heading, degrees";

constexpr std::array<PathFigure, 5> kCompassFigures{
    {{"4.2", 2}, {"4.3", 4}, {"4.4", 7}, {"4.5", 8}, {"4.6", 8, true}}};

ThesisFigure compass_figure(const PathFigure& figure, const analysis::ThesisCompassTrace& trace) {
  ThesisPanel error{"Error of the calibrated heading", kCircleLabel, "degrees", {}};
  if (!figure.noisy)
    error.curves.push_back(
        {"true coefficients, metric of the thesis", Ink::fit, trace.circle_deg, trace.perfect_error_deg});
  error.curves.push_back({"least squares", Ink::second, trace.circle_deg, trace.thesis_error_deg});
  error.curves.push_back({"navcal", Ink::first, trace.circle_deg, trace.navcal_error_deg});
  return {figure.id,
          title_of("Compass by least squares", figure),
          {track_panel(trace),
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

/// Figures 4.1 to 4.6.
std::vector<ThesisFigure> compass_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{thesis_deviation_figure()};
  for (const PathFigure& figure : kCompassFigures)
    figures.push_back(compass_figure(figure, trace_of_path(results.compass_traces, figure.path, figure.noisy)));
  return figures;
}

ThesisFigure field_figure(std::size_t row, const analysis::ThesisCircleTrace& trace) {
  const auto& printed = calib::thesis::kTable4_2.at(row);
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

/// Figures 4.7 to 4.12.
std::vector<ThesisFigure> circle_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures{thesis_hard_iron_figure()};
  for (std::size_t row = 0; row < results.circle_traces.size(); ++row)
    figures.push_back(field_figure(row, results.circle_traces.at(row)));
  return figures;
}

}  // namespace

std::vector<ThesisFigure> thesis_figures(const analysis::ThesisResults& results) {
  std::vector<ThesisFigure> figures;
  for (const auto& part :
       {thesis_model_figures(results), turn_figures(results), compass_figures(results), circle_figures(results)})
    figures.insert(figures.end(), part.begin(), part.end());
  for (ThesisFigure& figure : figures) {
    if (figure.caption.empty()) figure.caption = thesis_caption(figure.id);
  }
  return figures;
}

}  // namespace navcal::report
