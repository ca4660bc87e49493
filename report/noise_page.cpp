// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "analysis/noise/noise_run.h"
#include "report/html_page.h"
#include "report/noise_report.h"
#include "report/shown_number.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using NoiseInk = SvgPlot::Ink;
using analysis::RecordedChannel;

constexpr std::size_t kMostReadings = 1500, kMostDensities = 1000;

/// A logarithmic axis through all values, with a tick at each power of ten; where there are fewer than two of
/// those, also at 2 and 5 times.
SvgPlot::Axis log_axis(std::string label, const std::vector<double>& values) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    range = {std::min(range.least, std::log10(value)), std::max(range.most, std::log10(value))};
  }
  if (!(range.length() >= 0)) range = {-1, 1};
  range = {range.least - 0.1, range.most + 0.1};
  SvgPlot::Axis axis{std::move(label), range};
  const bool few = std::floor(range.most) - std::ceil(range.least) < 1;
  for (double power = std::floor(range.least); power <= range.most; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double at = power + std::log10(digit);
      if (range.contains(at) && (few || digit == 1))
        axis.ticks.push_back({at, fmt::format("{:g}", std::pow(10, at))});
    }
  }
  return axis;
}

Point log_point(double x, double y) {
  return {std::log10(x), y > 0 ? std::log10(y) : std::numeric_limits<double>::quiet_NaN()};
}

Figure readings_figure(const RecordedChannel& recorded, const analysis::NoiseReport& report) {
  const auto& [time_s, values] = recorded.series;
  std::vector<Point> points;
  for (std::size_t i = 0; i < values.size(); i += values.size() / kMostReadings + 1)
    points.push_back({time_s[i], values[i]});
  const Range y = whole_range_of(coordinates(&Point::y, points));
  SvgPlot plot(recorded.name(), {"seconds from the beginning", {0, std::max(report.duration_s, 1e-3)}},
               {recorded.unit, y});
  std::string name = report.chosen ? "chosen" : "at rest";
  for (const auto& interval : report.quiet) {
    const std::array<Point, 2> lower{{{interval.from_s, y.least}, {interval.to_s, y.least}}};
    const std::array<Point, 2> upper{{{interval.from_s, y.most}, {interval.to_s, y.most}}};
    plot.band(NoiseInk::third, name, lower, upper);
    name.clear();
  }
  plot.points(NoiseInk::first, "readings", points);
  return {"Readings", plot.svg(), "Shaded: the parts that the noise was taken from."};
}

struct TermCurve {
  const analysis::NoiseTerm& term;
  const char* name;
  NoiseInk ink;
  double (*deviation)(double value, double tau_s);
};

Figure allan_figure(const RecordedChannel& recorded) {
  const auto& points = recorded.noise.allan;
  const auto& terms = recorded.noise.terms;
  std::vector<double> taus, deviations;
  std::vector<Point> line, low, high;
  for (const auto& point : points) {
    taus.push_back(point.tau_s);
    deviations.insert(deviations.end(), {point.deviation, point.low, std::min(point.high, 10 * point.deviation)});
    line.push_back(log_point(point.tau_s, point.deviation));
    low.push_back(log_point(point.tau_s, point.low));
    high.push_back(log_point(point.tau_s, point.high));
  }
  SvgPlot plot("Allan deviation of " + recorded.name(), log_axis("averaging time, s", taus),
               log_axis(recorded.unit, deviations));
  plot.band(NoiseInk::first, "95 %", low, high);
  const std::array curves{
      TermCurve{terms.white, "white, -1/2", NoiseInk::second,
                [](double n, double tau_s) { return n / std::sqrt(tau_s); }},
      TermCurve{terms.flicker, "bias instability, 0", NoiseInk::third,
                [](double b, double) { return b * std::sqrt(2 * std::numbers::ln2 / std::numbers::pi); }},
      TermCurve{terms.walk, "random walk, +1/2", NoiseInk::fourth,
                [](double k, double tau_s) { return k * std::sqrt(tau_s / 3); }}};
  for (const TermCurve& curve : curves) {
    if (!curve.term.value) continue;
    const double first = taus.front(), last = taus.back();
    const std::array<Point, 2> ends{{log_point(first, curve.deviation(*curve.term.value, first)),
                                     log_point(last, curve.deviation(*curve.term.value, last))}};
    plot.line(curve.ink, curve.name, ends);
  }
  plot.line(NoiseInk::first, "measured", line);
  plot.points(NoiseInk::first, "", line);
  return {"Allan deviation", plot.svg(),
          "Overlapping estimate with its 95 % interval. Straight lines: the terms that the readings support, with "
          "their slopes."};
}

Figure spectrum_figure(const RecordedChannel& recorded) {
  const auto& spectrum = recorded.noise.spectrum;
  std::vector<double> frequencies, roots;
  std::vector<Point> line;
  // The largest of neighbouring values is shown, so that no line is lost.
  const std::size_t step = spectrum.density.size() / kMostDensities + 1;
  for (std::size_t i = 0; i < spectrum.density.size(); i += step) {
    const std::size_t end = std::min(i + step, spectrum.density.size());
    const auto largest = std::max_element(spectrum.density.begin() + static_cast<std::ptrdiff_t>(i),
                                          spectrum.density.begin() + static_cast<std::ptrdiff_t>(end));
    const auto at = static_cast<std::size_t>(largest - spectrum.density.begin());
    frequencies.push_back(spectrum.frequency_Hz[at]);
    roots.push_back(std::sqrt(*largest));
    line.push_back(log_point(frequencies.back(), roots.back()));
  }
  SvgPlot plot("Spectrum of " + recorded.name(), log_axis("Hz", frequencies),
               log_axis(recorded.unit + "/sqrt(Hz)", roots));
  plot.line(NoiseInk::first, "", line);
  for (const auto& found : recorded.noise.lines) {
    const auto nearest = std::ranges::min_element(frequencies, [&](double a, double b) {
      return std::abs(a - found.frequency_Hz) < std::abs(b - found.frequency_Hz);
    });
    const auto at = static_cast<std::size_t>(nearest - frequencies.begin());
    plot.word(log_point(*nearest, roots[at]), fmt::format("{:.3g} Hz", found.frequency_Hz));
  }
  return {"Spectrum", plot.svg(),
          fmt::format(
              "Root of the one-sided power density, {:.0f} segments. White noise of density N is level at 1.41 N.",
              spectrum.segments)};
}

/// Allan deviations of channels of one unit in one plot, four at most.
Figure allan_overview(const std::vector<const RecordedChannel*>& channels) {
  constexpr std::array kInks{NoiseInk::first, NoiseInk::second, NoiseInk::third, NoiseInk::fourth};
  const std::size_t shown = std::min(channels.size(), kInks.size());
  std::vector<double> taus, deviations;
  for (std::size_t i = 0; i < shown; ++i) {
    for (const auto& point : channels[i]->noise.allan) {
      taus.push_back(point.tau_s);
      deviations.push_back(point.deviation);
    }
  }
  const std::string& unit = channels.front()->unit;
  SvgPlot plot("Allan deviation", log_axis("averaging time, s", taus), log_axis(unit, deviations));
  for (std::size_t i = 0; i < shown; ++i) {
    std::vector<Point> line;
    for (const auto& point : channels[i]->noise.allan) line.push_back(log_point(point.tau_s, point.deviation));
    plot.line(kInks.at(i), channels[i]->quantity, line);
  }
  return {channels.front()->port + ", " + unit, plot.svg(), "Overlapping Allan deviation."};
}

/// Readings with the parts at rest, Allan deviation with its interval and the fitted terms, spectrum with its
/// lines. A figure that would be empty is left out.
std::vector<Figure> channel_figures(const RecordedChannel& recorded, const analysis::NoiseReport& report) {
  std::vector<Figure> figures;
  if (!recorded.series.values.empty()) figures.push_back(readings_figure(recorded, report));
  if (!recorded.noise.allan.empty()) figures.push_back(allan_figure(recorded));
  if (!recorded.noise.spectrum.density.empty()) figures.push_back(spectrum_figure(recorded));
  return figures;
}

using ChannelList = std::vector<const RecordedChannel*>;

/// Channels of a port that have an Allan deviation, four of one unit at most together.
std::vector<ChannelList> overview_groups(const analysis::NoiseReport& report) {
  constexpr std::size_t kTogether = 4;
  std::vector<ChannelList> groups;
  for (const RecordedChannel& recorded : report.channels) {
    if (recorded.noise.allan.empty()) continue;
    const auto fits = [&](const ChannelList& group) {
      return group.size() < kTogether && group.front()->port == recorded.port &&
             group.front()->unit == recorded.unit;
    };
    const auto group = std::ranges::find_if(groups, fits);
    if (group == groups.end())
      groups.push_back({&recorded});
    else
      group->push_back(&recorded);
  }
  return groups;
}

void append_remarks(HtmlPage& page, const analysis::NoiseReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& recorded : report.channels) {
    for (const auto& remark : noise_remarks(recorded)) rows.push_back({recorded.name(), remark});
  }
  if (rows.empty()) return;
  page.section("Remarks");
  page.table({"channel", "remark"}, rows);
}

}  // namespace

std::string noise_page(const analysis::NoiseReport& report) {
  HtmlPage page("Noise of " + report.file.substr(report.file.rfind('/') + 1));
  const bool found = !report.quiet.empty();
  page.fact(found ? "good" : "bad", found ? "rest" : "no rest", rest_sentence(report));
  for (const auto& remark : report.remarks) page.fact("plain", "recording", remark);
  std::vector<std::vector<std::string>> rows;
  for (const auto& recorded : report.channels) rows.push_back(noise_row(recorded, kPlusMinus));
  if (found && !rows.empty()) {
    page.section("Channels");
    page.table(noise_heads(), rows);
    page.paragraph(
        "The noise of a reading is one standard deviation, rounding included. White noise is the root of the "
        "two-sided power density (of a rate: the angle random walk). A value after < is a 95 % limit.");
  }
  std::vector<Figure> overview;
  for (const auto& group : overview_groups(report)) overview.push_back(allan_overview(group));
  if (!overview.empty()) {
    page.section("Allan deviations");
    page.figures(overview);
  }
  page.section("Each channel");
  for (const auto& recorded : report.channels) {
    const auto figures = channel_figures(recorded, report);
    if (!figures.empty()) page.folded_figures(recorded.name(), figures);
  }
  if (found) append_remarks(page, report);
  page.section("Made from");
  page.table({"", ""}, {{"Recording", report.file},
                        {"Length", duration_text(report.duration_s)},
                        {"Program", "navcal " NAVCAL_VERSION}});
  return std::move(page).finish();
}

}  // namespace navcal::report
