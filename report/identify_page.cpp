// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "report/html_page.h"
#include "report/identify_report.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

/// Fitted numbers about those of the file, in its standard errors: a stroke for each error, a point for each
/// value.
Figure identified_figure(const identify::Identification& found) {
  std::vector<Point> points;
  std::vector<double> ends{-2, 2};
  const auto count = static_cast<double>(found.parameters.size());
  for (std::size_t i = 0; i < found.parameters.size(); ++i) {
    const auto& one = found.parameters[i];
    const double away = (one.value - one.parameter.prior) / one.parameter.prior_std;
    const double error = one.std / one.parameter.prior_std;
    points.push_back({away, count - static_cast<double>(i)});
    ends.push_back(away - error);
    ends.push_back(away + error);
  }
  SvgPlot plot("fitted numbers in standard errors of the file",
               {"standard errors of the file", whole_range_of(ends)}, {"number", {0, count + 1}},
               {560, std::max(320.0, 60 + 14 * count)});
  const std::vector<Point> low{{-1, 0}, {-1, count + 1}}, high{{1, 0}, {1, count + 1}};
  plot.line(SvgPlot::Ink::before, "file, one standard error", low);
  plot.line(SvgPlot::Ink::before, "", high);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& one = found.parameters[i];
    const double error = one.std / one.parameter.prior_std;
    const std::vector<Point> stroke{{points[i].x - error, points[i].y}, {points[i].x + error, points[i].y}};
    plot.line(SvgPlot::Ink::after, i == 0 ? "fitted, one standard error" : "", stroke);
  }
  plot.points(SvgPlot::Ink::after, "", points);
  return {"Fitted numbers", plot.svg(),
          "From above in the order of the table. A stroke as long as the two lines are apart: the recordings do "
          "not tell the number."};
}

}  // namespace

std::string identify_page(const identify::Identification& found) {
  HtmlPage page("Identification of " + found.layout.name);
  const auto told = std::ranges::count_if(found.parameters, [](const auto& one) { return one.is_identified; });
  page.fact("plain", "told",
            fmt::format("{} of {} uncertain numbers, from {:.0f} s of recordings", told, found.parameters.size(),
                        found.seconds));
  page.fact(found.fitted.after < found.fitted.before ? "good" : "bad", "fit",
            rms_sentence("these recordings", found.fitted));
  if (found.held_out)
    page.fact(found.held_out->after < found.held_out->before ? "good" : "bad", "held out",
              rms_sentence("held-out recordings", *found.held_out));
  for (const auto& one : found.predictions)
    page.fact(one.after < one.before ? "good" : "bad", "held out", prediction_phrase(one));
  for (const auto& warning : found.warnings) page.fact("bad", "warning", warning);
  page.section("Numbers");
  std::vector<std::vector<std::string>> rows;
  for (const auto& one : found.parameters) rows.push_back(identify_row(one, kPlusMinus));
  page.table(identify_heads(), rows);
  page.figures({identified_figure(found)});
  if (!found.directions.empty()) page.section("What the recordings do not tell");
  for (const auto& direction : found.directions) page.paragraph(direction.words);
  if (!found.manoeuvres.empty()) page.section("What would tell more");
  for (const auto& advice : found.manoeuvres) page.paragraph(manoeuvre_sentence(advice));
  page.section("Unknown forces");
  for (const auto& of : found.disturbances) page.paragraph(disturbance_phrase(of));
  page.section("Residuals");
  std::vector<std::vector<std::string>> channels;
  for (const auto& fit : found.channels)
    channels.push_back({std::string(identify::describe(fit.channel).name), fmt::format("{}", fit.readings),
                        fmt::format("{:.2f}", fit.noise_scale), fmt::format("{:.2f}", fit.correlation)});
  page.table({"channel", "readings", "noise over stated noise", "correlation of neighbours"}, channels);
  if (!found.nuisances.empty()) {
    page.section("Instruments, current and delays");
    std::vector<std::vector<std::string>> nuisances;
    for (const auto& nuisance : found.nuisances)
      nuisances.push_back(
          {nuisance.recording, nuisance.name,
           fmt::format("{:.4g} {} {:.2g} {}", nuisance.value, kPlusMinus, nuisance.std, nuisance.unit)});
    page.table({"recording", "what", "value"}, nuisances);
  }
  return std::move(page).finish();
}

}  // namespace navcal::report
