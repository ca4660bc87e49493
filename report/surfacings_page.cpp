// SPDX-License-Identifier: Apache-2.0
#include "report/surfacings_page.h"

#include <algorithm>
#include <cmath>

#include "devices/instrument_model.h"
#include "report/html_page.h"
#include "report/surfacings_text.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using SurfacingInk = SvgPlot::Ink;

/// Ten bins of a round width.
Figure ttff_histogram(const std::vector<double>& times_s) {
  const double longest_s = *std::max_element(times_s.begin(), times_s.end());
  const double width_s = std::max(1.0, std::ceil(longest_s / 10));
  std::vector<double> counts(static_cast<std::size_t>(longest_s / width_s) + 1, 0);
  for (const double time_s : times_s) ++counts[static_cast<std::size_t>(time_s / width_s)];
  std::vector<Point> upper, lower;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (const std::size_t edge : {i, i + 1}) {
      const double x = static_cast<double>(edge) * width_s;
      upper.push_back({x, counts[i]});
      lower.push_back({x, 0});
    }
  }
  SvgPlot plot("Time to first fix", {"time to first fix, s", {0, static_cast<double>(counts.size()) * width_s}},
               {"surfacings", {0, *std::max_element(counts.begin(), counts.end()) * 1.1}});
  plot.band(SurfacingInk::first, "", lower, upper);
  plot.line(SurfacingInk::first, "", upper);
  return {"Distribution", plot.svg(), "Number of surfacings with a time to first fix within each bin."};
}

Figure ttff_against_submerged(const std::vector<Point>& points, const devices::GpsModel& gps) {
  double longest_s = 1, slowest_s = 1;
  for (const Point& point : points) {
    longest_s = std::max(longest_s, point.x);
    slowest_s = std::max(slowest_s, point.y);
  }
  std::vector<Point> mean, most;
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double unseen_s = longest_s * 1.05 * i / kSteps;
    mean.push_back({unseen_s, gps.mean_search_s(unseen_s)});
    most.push_back({unseen_s, gps.long_search_s(unseen_s)});
    slowest_s = std::max(slowest_s, most.back().y);
  }
  SvgPlot plot("Time to first fix against time under water", {"time under water, s", {0, longest_s * 1.05}},
               {"time to first fix, s", {0, slowest_s * 1.1}});
  plot.line(SurfacingInk::fit, "model, mean", mean);
  plot.line(SurfacingInk::third, "model, long", most);
  plot.points(SurfacingInk::first, "measured", points);
  return {
      "Dependence on the dive", plot.svg(),
      "Each point is a surfacing. The lines are the receiver's model of the configuration: mean and long search."};
}

Figure error_against_time(const std::vector<Point>& errors, const std::vector<Point>& stated) {
  std::vector<double> times_s{0}, metres{0};
  for (const auto* points : {&errors, &stated}) {
    for (const Point& point : *points) {
      times_s.push_back(point.x);
      metres.push_back(point.y);
    }
  }
  SvgPlot plot("Error of the dead reckoning", {"time without a fix, s", whole_range_of(times_s)},
               {"distance to the first fix, m", whole_range_of(metres)});
  plot.points(SurfacingInk::second, "stated standard error", stated);
  plot.points(SurfacingInk::first, "measured", errors);
  return {
      "Growth of the position error", plot.svg(),
      "Distance from the reckoned position to the first fix, whose own error is in it, and its stated standard "
      "error."};
}

}  // namespace

std::string surfacings_page(const std::vector<analysis::RecordedSurfacing>& surfacings,
                            const std::vector<std::string>& files, const config::Settings& settings) {
  std::vector<double> times_s;
  std::vector<Point> by_dive, errors, stated;
  for (const auto& found : surfacings) {
    const auto time_s = found.surfacing.time_to_first_fix_s(), submerged_s = found.surfacing.submerged_s(),
               without_fix_s = found.surfacing.without_fix_s();
    if (time_s) times_s.push_back(*time_s);
    if (time_s && submerged_s) by_dive.push_back({*submerged_s, *time_s});
    if (without_fix_s && found.error_m) errors.push_back({*without_fix_s, *found.error_m});
    if (without_fix_s && found.std_m) stated.push_back({*without_fix_s, *found.std_m});
  }
  HtmlPage page("Surfacings");
  page.section("Time to first fix");
  for (const auto& sentence : surfacing_sentences(statistics_of(surfacings))) page.paragraph(sentence);
  std::vector<Figure> figures;
  if (!times_s.empty()) figures.push_back(ttff_histogram(times_s));
  if (!by_dive.empty())
    figures.push_back(ttff_against_submerged(by_dive, devices::instrument_model(settings).gps));
  if (!errors.empty()) figures.push_back(error_against_time(errors, stated));
  if (!figures.empty()) page.figures(figures);
  page.section("Surfacings");
  std::vector<std::vector<std::string>> rows;
  for (const auto& found : surfacings) rows.push_back(surfacing_row(found));
  if (!rows.empty()) page.table(surfacing_heads(), rows);
  page.section("Made from");
  for (const auto& file : files) page.paragraph(file);
  return std::move(page).finish();
}

}  // namespace navcal::report
