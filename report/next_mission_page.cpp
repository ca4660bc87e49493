// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/angles.h"
#include "report/html_page.h"
#include "report/next_mission.h"
#include "report/plot_axes.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

/// Bars of a logarithmic scale from 1 to 1000.
std::string plan_bar_html(std::string_view name, double value, std::string_view unit, std::string_view detail) {
  const double share = std::clamp(std::log10(std::max(value, 1.0)) / 3, 0.0, 1.0);
  std::string html = fmt::format(
      "<b>{}</b><span class=\"bar\"><i class=\"fill{}\" style=\"left:0.0%;width:{:.1f}%\"></i></span><span "
      "class=\"value\">{:.0f} {}</span>\n",
      escaped(name), value < 10 ? " weak" : "", 100 * share, value, unit);
  if (!detail.empty()) html += "<span class=\"detail\">" + escaped(detail) + "</span>\n";
  return html;
}

Figure separation_figure(const gap::NextMission& next) {
  std::string html = "<div class=\"ranks\">\n";
  for (const auto& pair : next.pairs) {
    html += plan_bar_html(gap::set_text(pair.a) + " or " + gap::set_text(pair.b),
                          std::min(pair.separation_nats, pair.reverse_nats), "nats",
                          fmt::format("{:.0f} nats if {} is true, {:.0f} if {}", pair.separation_nats,
                                      gap::set_text(pair.a), pair.reverse_nats, gap::set_text(pair.b)));
  }
  html += "</div>\n";
  return {"Expected separation", std::move(html),
          "Expected evidence between each two sets, the smaller of both directions, from 1 to 1000 nats on a "
          "logarithmic scale. Below 10 nats (grey) they stay confounded."};
}

Figure planned_track(const gap::PlannedPath& path) {
  constexpr double kTrackSide = 460, kLeastLength_m = 2;
  std::vector<Point> way;
  for (std::size_t i = 0; i < path.time_s.size(); ++i) way.push_back({path.east_m[i], path.north_m[i]});
  Range east = whole_range_of(path.east_m), north = whole_range_of(path.north_m);
  make_equally_long(east, north, kLeastLength_m);
  SvgPlot plot("Path", {"east, m", east}, {"north, m", north}, {kTrackSide, kTrackSide});
  plot.line(Ink::after, "nominal vehicle", way);
  return {"Path", plot.svg(), "Path of the nominal vehicle in still water, from where the mission begins."};
}

Figure course_figure(std::string_view title, const char* unit, const gap::PlannedPath& path,
                     const std::vector<double>& values, double scale, std::string caption) {
  const TimeAxis time(path.time_s);
  std::vector<Point> line;
  for (std::size_t i = 0; i < path.time_s.size(); ++i) line.push_back({time(path.time_s[i]), scale * values[i]});
  SvgPlot plot(title, time.axis(), {unit, whole_range_of(coordinates(&Point::y, line))});
  plot.line(Ink::after, "", line);
  return {std::string(title), plot.svg(), std::move(caption)};
}

Figure planned_heading(const gap::PlannedPath& path) {
  const TimeAxis time(path.time_s);
  std::vector<double> headings_deg;
  for (const double rad : path.heading_rad) headings_deg.push_back(rad * base::kDegreesPerRadian);
  const HeadingAxis heading(headings_deg);
  std::vector<Point> points;
  for (std::size_t i = 0; i < headings_deg.size(); ++i)
    points.push_back({time(path.time_s[i]), heading(headings_deg[i])});
  SvgPlot plot("Heading", time.axis(), heading.axis("heading"));
  plot.points(Ink::after, "", points);
  return {"Heading", plot.svg(), "True heading."};
}

std::vector<Figure> planned_motion_figures(const gap::PlannedPath& path) {
  std::vector<Figure> figures{planned_track(path),
                              course_figure("Depth", "m", path, path.depth_m, 1, "Depth of the origin."),
                              planned_heading(path)};
  figures.push_back(course_figure("Rate of turn", "deg/s", path, path.turn_rad_s, base::kDegreesPerRadian,
                                  "Positive to starboard."));
  figures.push_back(course_figure("Speed", "m/s", path, path.speed_m_s, 1, "Through the water."));
  return figures;
}

void append_strengths(HtmlPage& page, const gap::NextMission& next) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& each : next.strengths) {
    rows.push_back({each.effect, each.parameter, gap::strength_text(each.before), gap::strength_text(each.after)});
  }
  page.section("Smallest strength that shows");
  page.paragraph(
      "Strength of each effect's weakest parameter, in typical strengths, that gives 10 nats of evidence.");
  page.table({"Effect", "Parameter", "So far", "With this mission"}, rows);
}

void append_limits(HtmlPage& page, const gap::NextMission& next) {
  const auto& most = next.extremes;
  const auto& limits = next.limits;
  std::vector<std::vector<std::string>> rows;
  const auto row = [&](const char* name, std::optional<double> value, double limit, const char* unit,
                       double scale = 1) {
    if (value)
      rows.push_back(
          {name, fmt::format("{:.3g} {}", scale * *value, unit), fmt::format("{:.3g} {}", scale * limit, unit)});
  };
  row("Duration", most.duration_s / 60, limits.duration_s / 60, "min");
  row("Greatest depth", most.greatest_depth_m, limits.greatest_depth_m, "m");
  row("Distance", most.range_m, limits.range_m, "m");
  row("Speed", most.speed_m_s, limits.speed_m_s, "m/s");
  row("Shaft", most.shaft_rps, limits.shaft_rps, "rpm", 60);
  row("Rate of turn", most.turn_rad_s, limits.turn_rad_s, "deg/s", base::kDegreesPerRadian);
  row("Energy", most.energy_Wh, limits.energy_Wh, "Wh");
  page.section("Limits");
  page.table({"", "Mission", "Limit"}, rows);
}

}  // namespace

std::string next_mission_page(const gap::NextMission& next, const NextMissionSource& source) {
  HtmlPage page("The next mission: " + std::filesystem::path(source.mission).filename().string());
  const bool good = next.decides || next.purpose != gap::MissionPurpose::separate;
  page.fact(good ? "good" : "bad", gap::name_of(next.purpose), next.sentence);
  for (const auto& remark : next.remarks) page.fact("plain", "remark", remark);
  if (next.purpose != gap::MissionPurpose::sharpen) {
    page.section("What it tells apart");
    page.figures({separation_figure(next)});
  }
  if (next.purpose == gap::MissionPurpose::cover) {
    page.section("Regimes that no recording has seen");
    for (const auto& each : next.newly_covered) page.fact("plain", "new", each);
  }
  if (next.purpose == gap::MissionPurpose::sharpen) append_strengths(page, next);
  page.section("The mission");
  page.figures(planned_motion_figures(next.path));
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < next.manoeuvres.size(); ++i)
    rows.push_back({fmt::format("{}", i + 1), next.manoeuvres[i]});
  page.table({"", "Manoeuvre"}, rows);
  append_limits(page, next);
  page.section("Made from");
  rows.clear();
  for (const auto& file : source.recordings) rows.push_back({"Recording", file});
  for (const auto& file : source.holdouts) rows.push_back({"Held out", file});
  for (const auto& file : source.nominals) rows.push_back({"Nominal", file});
  rows.push_back({"Nominal vehicle", source.vehicle.empty() ? "the reference vehicle" : source.vehicle});
  rows.push_back({"Limits", source.limits.empty() ? "the usual ones" : source.limits});
  rows.push_back({"Program", "navcal " NAVCAL_VERSION});
  page.table({"", ""}, rows);
  return std::move(page).finish();
}

}  // namespace navcal::report
