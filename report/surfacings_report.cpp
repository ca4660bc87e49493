// SPDX-License-Identifier: Apache-2.0
#include "report/surfacings_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/utc_text.h"
#include "devices/instrument_model.h"
#include "record/json/put_members.h"
#include "report/html_page.h"
#include "report/svg_plot.h"
#include "report/wrapped_text.h"
#include "validation/score.h"

namespace navcal::report {
namespace {

std::string cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string cell(const std::optional<std::uint8_t>& count) { return count ? fmt::format("{}", *count) : "-"; }

std::string first_fix_text(std::int64_t utc_ns) {
  std::string text = base::utc_text(utc_ns).substr(0, 19);
  text[10] = ' ';
  return text;
}

nlohmann::json json_of(const analysis::RecordedSurfacing& found) {
  const auto& surfacing = found.surfacing;
  nlohmann::json json{{"time", static_cast<double>(found.first_fix_utc_ns) * 1e-9},
                      {"without_fix_s", surfacing.without_fix_s()},
                      {"submerged_s", surfacing.submerged_s()},
                      {"ttff_s", surfacing.time_to_first_fix_s()}};
  NAVCAL_PUT_MEMBERS(json, surfacing, deepest_m, visible, tracked, dop);
  NAVCAL_PUT_MEMBERS(json, found, file, distance_m, error_m, std_m, error_uncalibrated_m);
  return json;
}

using SurfacingInk = SvgPlot::Ink;

/// Ten bins of a round width.
Figure ttff_histogram(const std::vector<double>& times_s) {
  const double longest_s = *std::ranges::max_element(times_s);
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
               {"surfacings", {0, *std::ranges::max_element(counts) * 1.1}});
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
  const auto range = [&](double Point::*axis) { return whole_range_of(coordinates(axis, kZero, errors, stated)); };
  SvgPlot plot("Error of the dead reckoning", {"time without a fix, s", range(&Point::x)},
               {"distance to the first fix, m", range(&Point::y)});
  plot.points(SurfacingInk::second, "stated standard error", stated);
  plot.points(SurfacingInk::first, "measured", errors);
  return {"Growth of the position error", plot.svg(),
          "Distance from the reckoned position to the first fix, whose own error is in it, and its stated "
          "standard error."};
}

}  // namespace

SurfacingStatistics statistics_of(const std::vector<analysis::RecordedSurfacing>& surfacings) {
  SurfacingStatistics statistics;
  statistics.count = surfacings.size();
  std::vector<double> times_s;
  double squares = 0;
  for (const auto& found : surfacings) {
    if (const auto time_s = found.surfacing.time_to_first_fix_s()) times_s.push_back(*time_s);
    if (!found.error_m || !found.std_m || *found.std_m <= 0) continue;
    ++statistics.with_error;
    squares += std::pow(*found.error_m / *found.std_m, 2);
  }
  statistics.with_ttff = times_s.size();
  if (!times_s.empty()) {
    std::ranges::sort(times_s);
    statistics.ttff_least_s = validation::quantile(times_s, 0);
    statistics.ttff_longest_s = validation::quantile(times_s, 1);
    statistics.ttff_median_s = validation::quantile(times_s, 0.5);
    statistics.ttff_p90_s = validation::quantile(times_s, 0.9);
    statistics.ttff_mean_s =
        std::accumulate(times_s.begin(), times_s.end(), 0.0) / static_cast<double>(times_s.size());
  }
  if (statistics.with_error > 0)
    statistics.error_over_std = std::sqrt(squares / static_cast<double>(statistics.with_error));
  return statistics;
}

std::vector<std::string> surfacing_heads() {
  return {"first fix, UTC", "no fix, s", "under water, s", "deepest, m", "TTFF, s",
          "satellites",     "DOP",       "way, m",         "error, m",   "stated, m"};
}

std::vector<std::string> surfacing_row(const analysis::RecordedSurfacing& found) {
  const auto& surfacing = found.surfacing;
  return {first_fix_text(found.first_fix_utc_ns),
          cell(surfacing.without_fix_s(), 0),
          cell(surfacing.submerged_s(), 0),
          cell(surfacing.deepest_m, 1),
          cell(surfacing.time_to_first_fix_s(), 1),
          cell(surfacing.tracked) + "/" + cell(surfacing.visible),
          cell(surfacing.dop, 1),
          cell(found.distance_m, 0),
          cell(found.error_m, 1),
          cell(found.std_m, 1)};
}

std::vector<std::string> surfacing_sentences(const SurfacingStatistics& statistics) {
  std::vector<std::string> sentences;
  sentences.push_back(fmt::format("{} surfacings.", statistics.count));
  if (statistics.count > statistics.with_ttff) {
    sentences.push_back(
        fmt::format("The time of surfacing is not known for {}: there is no reading of a depth gauge.",
                    statistics.count - statistics.with_ttff));
  }
  if (statistics.ttff_median_s) {
    sentences.push_back(fmt::format(
        "Time to first fix: median {:.1f} s, mean {:.1f} s, 90 % within {:.1f} s, from {:.1f} to {:.1f} s.",
        *statistics.ttff_median_s, *statistics.ttff_mean_s, *statistics.ttff_p90_s, *statistics.ttff_least_s,
        *statistics.ttff_longest_s));
  }
  if (statistics.error_over_std) {
    sentences.push_back(
        fmt::format("Error of the dead reckoning over its stated standard error: {:.2f} (root mean square of {}).",
                    *statistics.error_over_std, statistics.with_error));
  }
  return sentences;
}

std::string surfacings_text(const std::vector<analysis::RecordedSurfacing>& surfacings) {
  std::vector<std::vector<std::string>> rows{surfacing_heads()};
  for (const auto& found : surfacings) rows.push_back(surfacing_row(found));
  std::string out;
  if (!surfacings.empty()) {
    for (const std::string& line : table_lines(rows, 0)) out += line;
  }
  for (const auto& sentence : surfacing_sentences(statistics_of(surfacings))) out += sentence + '\n';
  return out;
}

std::string surfacings_json(const std::vector<analysis::RecordedSurfacing>& surfacings,
                            const std::vector<std::string>& files) {
  auto list = nlohmann::json::array();
  for (const auto& found : surfacings) list.push_back(json_of(found));
  const SurfacingStatistics statistics = statistics_of(surfacings);
  nlohmann::json json{{"class", "SURFACINGS"}, {"files", files}, {"surfacings", list}};
  NAVCAL_PUT_MEMBERS(json["statistics"], statistics, count, with_ttff, ttff_least_s, ttff_median_s, ttff_mean_s,
                     ttff_p90_s, ttff_longest_s, with_error, error_over_std);
  return json.dump() + '\n';
}

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
