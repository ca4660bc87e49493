// SPDX-License-Identifier: Apache-2.0
#include "report/next_mission_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/angles.h"
#include "report/gap_words.h"
#include "report/html_page.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using PlanJson = nlohmann::ordered_json;
using PlanInk = SvgPlot::Ink;

constexpr double kJoulesPerWattHour = 3600;
/// Pairs that the text lists, and bars of the picture; the JSON has all.
constexpr std::size_t kMostPairs = 12, kMostBars = 24;

std::string text_of(const std::vector<std::string>& set) {
  return set.empty() ? "no effect" : fmt::format("{}", fmt::join(set, " + "));
}

std::string minutes_text(double seconds) {
  return fmt::format("{}:{:02}", static_cast<int>(seconds) / 60, static_cast<int>(seconds) % 60);
}

Figure path_figure(const gap::NextMission& next) {
  std::vector<Point> path;
  std::vector<double> east, north;
  for (const gap::PlannedInstant& now : next.track) {
    path.push_back({now.east_m, now.north_m});
    east.push_back(now.east_m);
    north.push_back(now.north_m);
  }
  Range x = whole_range_of(east), y = whole_range_of(north);
  make_equally_long(x, y, 10);
  SvgPlot plot("Path", {"east, m", x}, {"north, m", y}, {420, 420});
  plot.line(PlanInk::first, "planned", path);
  if (!path.empty()) plot.word(path.front(), "start");
  return {"Path", plot.svg(), "As the nominal vehicle would sail it, without a current."};
}

Figure course_figure(const gap::NextMission& next, const char* title, const char* label,
                     double (*value)(const gap::PlannedInstant&)) {
  std::vector<Point> line;
  std::vector<double> values;
  for (const gap::PlannedInstant& now : next.track) {
    line.push_back({now.time_s, value(now)});
    values.push_back(line.back().y);
  }
  SvgPlot plot(title, {"seconds", {0, std::max(1.0, next.duration_s)}}, {label, whole_range_of(values)},
               {560, 200});
  plot.line(PlanInk::first, "", line);
  return {title, plot.svg(), ""};
}

/// Bars: one for each pair, the least separated first.
Figure separation_figure(const gap::NextMission& next) {
  const std::size_t count = std::min(next.pairs.size(), kMostBars);
  SvgPlot::Axis y{"pair", {-0.7, static_cast<double>(count) - 0.3}, 0, {}};
  double most = 10;
  for (std::size_t i = 0; i < count; ++i) most = std::max(most, std::min(next.pairs[i].separation_nats, 100.0));
  for (std::size_t i = 0; i < count; ++i)
    y.ticks.push_back({static_cast<double>(count - 1 - i), fmt::format("{}", i + 1)});
  SvgPlot plot("Expected separation", {"nats (those above 100 end there)", {0, 1.05 * most}}, y,
               {560, std::max(160.0, 18.0 * static_cast<double>(count) + 80)});
  for (std::size_t i = 0; i < count; ++i) {
    const double row = static_cast<double>(count - 1 - i);
    const double nats = std::min(next.pairs[i].separation_nats, 100.0);
    const std::vector<Point> lower{{0, row - 0.3}, {nats, row - 0.3}}, upper{{0, row + 0.3}, {nats, row + 0.3}};
    plot.band(PlanInk::after, "", lower, upper);
  }
  return {"Separation", plot.svg(), "Numbers are those of the table. 10 nats decide."};
}

}  // namespace

std::string next_mission_json(const gap::NextMission& next, const std::string& file) {
  PlanJson json{{"mission", file},
                {"minutes", next.duration_s / 60},
                {"decides", next.decides},
                {"probability_exact", next.probability_exact}};
  json["pairs"] = PlanJson::array();
  for (const gap::SeparatedPair& pair : next.pairs) {
    json["pairs"].push_back({{"a", pair.a},
                             {"b", pair.b},
                             {"separation_nats", pair.separation_nats},
                             {"log_odds_so_far_nats", pair.so_far_nats}});
  }
  json["sentence"] = next.sentence;
  json["purpose"] = gap::name_of(next.purpose);
  json["probability_so_far"] = next.probability_so_far;
  json["covers"] = next.covers;
  json["manoeuvres"] = PlanJson::array();
  for (const gap::ChosenManoeuvre& one : next.manoeuvres) {
    json["manoeuvres"].push_back({{"from_s", one.from_s}, {"name", one.name}});
  }
  json["energy_Wh"] = next.energy_J / kJoulesPerWattHour;
  json["verdict"] = gap::name_of(next.diagnosis.verdict);
  json["seconds"] = next.seconds;
  return json.dump(-1, ' ', false, PlanJson::error_handler_t::replace);
}

std::string next_mission_text(const gap::NextMission& next, const std::string& file) {
  std::string text = fmt::format("so far: {}\n\n{}\n\n", next.diagnosis.sentence, next.sentence);
  text += fmt::format("{}: {} of mission, {:.1f} Wh of the motor\n", file, minutes_text(next.duration_s),
                      next.energy_J / kJoulesPerWattHour);
  for (const gap::ChosenManoeuvre& one : next.manoeuvres) {
    text += fmt::format("  {:>6}  {}\n", minutes_text(one.from_s), one.name);
  }
  if (!next.pairs.empty()) text += "\nexpected separation (10 nats decide)\n";
  for (std::size_t i = 0; i < std::min(next.pairs.size(), kMostPairs); ++i) {
    const gap::SeparatedPair& pair = next.pairs[i];
    text += fmt::format("  {:7.1f} nats  {}  from  {}\n", pair.separation_nats, text_of(pair.a), text_of(pair.b));
  }
  if (next.pairs.size() > kMostPairs)
    text += fmt::format("  and {} more, in --json\n", next.pairs.size() - kMostPairs);
  if (next.purpose == gap::DesignPurpose::test) return text;
  text += fmt::format("\nan exact answer has a probability of {:.2f} after it, of {:.2f} without it\n",
                      next.probability_exact, next.probability_so_far);
  return text;
}

std::string next_mission_page(const gap::NextMission& next, const std::string& file) {
  HtmlPage page("The next mission");
  page.paragraph(next.sentence);
  page.paragraph("So far: " + next.diagnosis.sentence);
  page.section("The mission");
  std::vector<std::vector<std::string>> rows;
  for (const gap::ChosenManoeuvre& one : next.manoeuvres) rows.push_back({minutes_text(one.from_s), one.name});
  page.table({"from", "manoeuvre"}, rows);
  page.figures(
      {path_figure(next),
       course_figure(next, "Depth", "depth, m", [](const gap::PlannedInstant& now) { return now.depth_m; }),
       course_figure(next, "Heading", "heading, degrees",
                     [](const gap::PlannedInstant& now) { return now.heading_rad * base::kDegreesPerRadian; }),
       course_figure(next, "Shaft", "shaft speed, rpm",
                     [](const gap::PlannedInstant& now) { return 60 * now.shaft_rps; })});
  if (!next.pairs.empty()) {
    page.section("What it is expected to tell apart");
    page.figures({separation_figure(next)});
    std::vector<std::vector<std::string>> pairs;
    for (std::size_t i = 0; i < next.pairs.size(); ++i) {
      pairs.push_back({fmt::format("{}", i + 1), text_of(next.pairs[i].a), text_of(next.pairs[i].b),
                       fmt::format("{:.1f}", next.pairs[i].separation_nats),
                       fmt::format("{:.1f}", next.pairs[i].so_far_nats)});
    }
    page.table({"pair", "one", "other", "nats expected", "log odds so far"}, pairs);
  }
  page.section("Made from");
  page.paragraph(fmt::format("Mission file {}: {} long, {:.1f} Wh of the motor.", file,
                             minutes_text(next.duration_s), next.energy_J / kJoulesPerWattHour));
  return std::move(page).finish();
}

}  // namespace navcal::report
