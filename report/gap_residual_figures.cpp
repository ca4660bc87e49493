// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "report/gap_figures.h"
#include "report/plot_axes.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

constexpr std::size_t kMostResidualDots = 1500;
constexpr std::size_t kMeans = 16, kLeastInMean = 8;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + ", " + unit;
}

/// Number of intervals: all of them, or fewer if there are too many to be visible.
std::vector<Point> paired(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = std::min(x.size(), y.size());
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; i += n / kMostResidualDots + 1) points.push_back({x[i], y[i]});
  return points;
}

/// Means of groups of equal size, from left to right.
std::vector<Point> trend(std::vector<Point> points) {
  std::erase_if(points, [](const Point& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
  std::ranges::sort(points, [](const Point& a, const Point& b) { return a.x < b.x; });
  const std::size_t groups = std::min(kMeans, points.size() / kLeastInMean);
  std::vector<Point> means;
  for (std::size_t group = 0; group < groups; ++group) {
    const std::size_t begin = points.size() * group / groups, end = points.size() * (group + 1) / groups;
    Point mean;
    for (std::size_t i = begin; i < end; ++i) {
      mean.x += points[i].x / static_cast<double>(end - begin);
      mean.y += points[i].y / static_cast<double>(end - begin);
    }
    means.push_back(mean);
  }
  return means;
}

Figure course_figure(const gap::Course& course) {
  const TimeAxis time(course.time_s);
  std::vector<double> times;
  for (const double time_s : course.time_s) times.push_back(time(time_s));
  const auto before = paired(times, course.before), after = paired(times, course.after);
  SvgPlot plot(course.channel, time.axis(),
               {with_unit("residual", course.unit), whole_range_of(coordinates(&Point::y, kZero, before, after))});
  plot.level(0);
  plot.line(Ink::before, "before", before);
  plot.line(Ink::after, "after", after);
  return {course.channel, plot.svg(), "Means of equal intervals."};
}

}  // namespace

std::optional<Figure> scatter_figure(const gap::Diagnosis& diagnosis) {
  if (!diagnosis.scatter || diagnosis.scatter->driver_value.empty()) return std::nullopt;
  const gap::Scatter& scatter = *diagnosis.scatter;
  const auto before = paired(scatter.driver_value, scatter.before);
  const auto after = paired(scatter.driver_value, scatter.after);
  const std::string driver = spaced(scatter.driver), title = scatter.channel + " against " + driver;
  SvgPlot plot(title, {with_unit(driver, scatter.driver_unit), range_of(scatter.driver_value)},
               {with_unit("residual", scatter.unit), range_of(coordinates(&Point::y, kZero, before, after))});
  plot.points(Ink::before, "before", before);
  plot.points(Ink::after, "after", after);
  plot.level(0);
  plot.line(Ink::before, "", trend(before));
  plot.line(Ink::after, "", trend(after));
  return Figure{title, plot.svg(),
                "Each dot is a residual of the mission; lines are means. Explained residuals are flat."};
}

CourseFigures course_figures(const gap::Diagnosis& diagnosis) {
  constexpr std::size_t kMostOfTheGap = 3;
  CourseFigures figures;
  std::vector<const gap::Course*> left;
  for (const auto& course : diagnosis.courses) left.push_back(&course);
  for (const auto& entry : diagnosis.where) {
    const auto found =
        std::ranges::find_if(left, [&](const gap::Course* course) { return course->channel == entry.channel; });
    if (found == left.end() || figures.of_the_gap.size() == kMostOfTheGap) continue;
    figures.of_the_gap.push_back(course_figure(**found));
    left.erase(found);
  }
  for (const gap::Course* const course : left) figures.others.push_back(course_figure(*course));
  return figures;
}

}  // namespace navcal::report
