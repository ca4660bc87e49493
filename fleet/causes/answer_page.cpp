// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fleet/causes/answer_report.h"
#include "fleet/causes/limits.h"
#include "report/html_page.h"
#include "report/svg_matrix.h"
#include "report/svg_plot.h"

namespace navcal::fleet {
namespace {

using FleetInk = report::SvgPlot::Ink;
using FleetRow = std::vector<std::string>;

/// Most rows of a table and most histories with a picture: a page with more hardly scrolls. The JSON has all.
constexpr std::size_t kMostMissions = 1000, kMostHistories = 24;
/// Most days of the picture.
constexpr std::size_t kMostDays = 40;
/// Power above its floor, in the scatter of the floor, from which a mission is drawn as one with a gap.
constexpr double kLoud_sigma = kFleetGap_sigma;

std::vector<FleetRow> rows_of(const std::vector<FoundCause>& causes, const PooledMissions& missions) {
  std::vector<FleetRow> rows;
  for (const FoundCause& cause : causes) {
    std::string others;
    for (const Alternative& other : cause.alternatives) {
      others += fmt::format("{}{} ({:.0f} %)", others.empty() ? "" : "; ", text_of(other.cause, missions),
                            100 * other.probability);
    }
    rows.push_back({std::string(name_of(cause.acting.cause.level)), text_of(cause, missions),
                    fmt::format("{:.2f}", strength_of(cause)), others});
  }
  return rows;
}

class FleetPage {
 public:
  explicit FleetPage(const FleetStory& story) : story_(story), missions_(story.missions) {
    first_ns_ = missions_.missions().front().utc_ns;
    last_day_ = std::max(day(missions_.missions().back().utc_ns), 1e-3);
  }

  std::string html() {
    report::HtmlPage page("Fleet");
    page.paragraph(fmt::format("{} missions of {} vehicles on {} days.", missions_.missions().size(),
                               missions_.vehicles().size(), missions_.days().size()));
    page.section("What belongs to whom");
    causes(page);
    page.section("Vehicles by time");
    page.wide_figures({vehicles_by_time(), closure_by_vehicle()});
    vehicles(page);
    if (!story_.calibrations.empty()) {
      page.section("Calibrations");
      calibrations(page);
    }
    page.section("Missions");
    mission_table(page);
    if (!story_.remarks.empty()) {
      page.section("Remarks");
      for (const std::string& remark : story_.remarks) page.paragraph(remark);
    }
    return std::move(page).finish();
  }

 private:
  [[nodiscard]] double day(std::int64_t utc_ns) const {
    return static_cast<double>(utc_ns - first_ns_) / kNanosecondsPerDay;
  }

  void causes(report::HtmlPage& page) const {
    const FleetRow heads{"belongs to", "cause", "strength (typical values)", "or"};
    if (story_.answer.causes.empty()) page.paragraph("No cause is probable enough to be named.");
    if (!story_.answer.causes.empty()) page.table(heads, rows_of(story_.answer.causes, missions_));
    if (!story_.answer.undecided.empty()) {
      page.heading("Not decided");
      page.paragraph("Something is there. What it is or whose it is, these missions do not decide.");
      page.table(heads, rows_of(story_.answer.undecided, missions_));
    }
    if (!story_.answer.tolerances.empty()) {
      page.heading("Within tolerance");
      page.table(heads, rows_of(story_.answer.tolerances, missions_));
    }
  }

  /// A row for each vehicle, a cell for each day: by how much its residuals exceed the floor, and whether the
  /// causes close that.
  [[nodiscard]] report::Figure vehicles_by_time() const {
    std::vector<std::string> days;
    for (const FleetMission& mission : missions_.missions()) {
      if (std::find(days.begin(), days.end(), mission.day) == days.end()) days.push_back(mission.day);
    }
    const std::size_t from = days.size() > kMostDays ? days.size() - kMostDays : 0;
    days.erase(days.begin(), days.begin() + static_cast<std::ptrdiff_t>(from));
    report::SvgMatrix matrix;
    matrix.columns = days;
    for (const MissionGroup& vehicle : missions_.vehicles()) {
      matrix.rows.push_back(vehicle.name);
      std::vector<int> excess(days.size(), 0);
      std::vector<bool> closed(days.size(), true);
      for (const std::size_t m : vehicle.missions) {
        const auto day = std::find(days.begin(), days.end(), missions_.missions()[m].day);
        if (day == days.end()) continue;
        const auto column = static_cast<std::size_t>(day - days.begin());
        const MissionGap& gap = story_.answer.missions[m];
        const double scatter = std::max(gap.floor_std, 1e-9);
        excess[column] =
            std::max(excess[column], static_cast<int>(std::max(0.0, (gap.before - gap.floor) / scatter)));
        if (gap.after > gap.floor + kLoud_sigma * scatter) closed[column] = false;
      }
      matrix.counts.push_back(std::move(excess));
      matrix.agreeing.push_back(std::move(closed));
    }
    return {"Vehicles by time", matrix.svg("Excess over the floor"),
            fmt::format("By how many standard deviations of missions without a gap the residuals of the nominal "
                        "model exceed their mean. Blue: the causes close it; orange: it is left.{}",
                        from > 0 ? fmt::format(" The last {} days.", kMostDays) : "")};
  }

  [[nodiscard]] report::Figure closure_by_vehicle() const {
    const auto& vehicles = story_.answer.vehicles;
    std::vector<report::Point> before, after, floor;
    double most = 1;
    report::SvgPlot::Axis x{"vehicle", {-0.6, static_cast<double>(vehicles.size()) - 0.4}, 0, {}};
    for (std::size_t v = 0; v < vehicles.size(); ++v) {
      const auto at = static_cast<double>(v);
      x.ticks.push_back({at, vehicles[v].vehicle.substr(0, 8)});
      before.push_back({at, vehicles[v].gap.before});
      after.push_back({at, vehicles[v].gap.after});
      floor.push_back({at, vehicles[v].gap.floor});
      most = std::max(most, vehicles[v].gap.before);
    }
    report::SvgPlot plot("Gap of each vehicle", x, {"power of the residuals", {0.8, 1.1 * most}}, {1100, 280});
    plot.points(FleetInk::fit, "floor", floor);
    plot.points(FleetInk::before, "nominal model", before);
    plot.points(FleetInk::after, "with the causes", after);
    return {"Closure", plot.svg(),
            "Mean over the missions of each vehicle. 1 is the noise of the nominal vehicle. The causes in a "
            "mission's model were determined by other missions."};
  }

  void vehicles(report::HtmlPage& page) const {
    std::vector<FleetRow> rows;
    for (const VehicleAnswer& vehicle : story_.answer.vehicles) {
      rows.push_back({vehicle.vehicle, std::string(name_of(vehicle.verdict)),
                      fmt::format("{:.3f}", vehicle.gap.before), fmt::format("{:.3f}", vehicle.gap.after),
                      fmt::format("{:.3f}", vehicle.gap.floor),
                      vehicle.closed ? fmt::format("{:.0f} %", 100 * *vehicle.closed) : "", vehicle.reason});
    }
    page.table({"vehicle", "verdict", "before", "after", "floor", "closed", "why unknown"}, rows);
  }

  void calibrations(report::HtmlPage& page) const {
    std::vector<report::Figure> figures;
    std::vector<FleetRow> rows;
    for (const CalibrationHistory& history : story_.calibrations) {
      if (history.course == CalibrationCourse::too_few) continue;
      rows.push_back({history.subject, history.quantity, std::string(name_of(history.course)),
                      std::to_string(history.points.size())});
      if (history.course != CalibrationCourse::constant && figures.size() < kMostHistories) {
        figures.push_back(figure_of(history));
      }
    }
    if (rows.empty()) page.paragraph("No value was calibrated in three missions.");
    if (!figures.empty()) page.figures(figures);
    if (!rows.empty()) page.table({"of", "value", "course", "missions"}, rows);
  }

  [[nodiscard]] report::Figure figure_of(const CalibrationHistory& history) const {
    std::vector<report::Point> points, upper, lower;
    std::vector<double> edges;
    for (const CalibrationPoint& point : history.points) {
      const double at = day(point.utc_ns);
      points.push_back({at, point.value});
      upper.push_back({at, point.value + point.std});
      lower.push_back({at, point.value - point.std});
      edges.insert(edges.end(), {point.value + point.std, point.value - point.std});
    }
    report::SvgPlot plot(history.quantity, {"days since the first mission", {-0.02 * last_day_, 1.02 * last_day_}},
                         {"value", report::whole_range_of(edges)});
    plot.band(FleetInk::fit, "one standard error", lower, upper);
    plot.points(FleetInk::first, "calibrated", points);
    return {history.subject + ": " + history.quantity, plot.svg(), std::string(name_of(history.course))};
  }

  void mission_table(report::HtmlPage& page) const {
    std::vector<std::size_t> order(missions_.missions().size());
    for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
    const auto excess = [&](std::size_t m) {
      const MissionGap& gap = story_.answer.missions[m];
      return (gap.after - gap.floor) / std::max(gap.floor_std, 1e-9);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return excess(a) > excess(b); });
    std::vector<FleetRow> rows;
    for (const std::size_t m : order) {
      if (rows.size() == kMostMissions) break;
      const FleetMission& of = missions_.missions()[m];
      const MissionGap& gap = story_.answer.missions[m];
      rows.push_back({of.recording, of.vehicle, of.day, fmt::format("{:.3f}", gap.before),
                      fmt::format("{:.3f}", gap.after), fmt::format("{:.1f}", excess(m))});
    }
    page.paragraph(
        "Outliers first: missions whose residuals exceed the floor most, with the causes in the model.");
    page.table({"recording", "vehicle", "day", "before", "after", "excess (standard deviations)"}, rows);
    if (order.size() > kMostMissions) {
      page.paragraph(fmt::format("The first {} of {}; the JSON has all.", kMostMissions, order.size()));
    }
  }

  const FleetStory& story_;
  const PooledMissions& missions_;
  std::int64_t first_ns_ = 0;
  double last_day_ = 1;
};

}  // namespace

std::string fleet_page(const FleetStory& story) { return FleetPage(story).html(); }

}  // namespace navcal::fleet
