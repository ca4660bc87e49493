// SPDX-License-Identifier: Apache-2.0
// Estimates over time.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/angles.h"
#include "report/calibrate_figures.h"
#include "report/plot_axes.h"
#include "report/svg_plot.h"

namespace navcal::report {
namespace {

using Ink = SvgPlot::Ink;

constexpr std::size_t kLeastPoints = 4;

struct Curve {
  const char* estimate;
  const char* name;
};
/// Curves of one diagram.
struct Group {
  const char* title;
  const char* unit;
  double factor;
  std::array<Curve, 4> curves;
};
constexpr std::array kGroups{
    Group{"Gyros: scale", "scale", 1, {{{"gyro.scale", "A"}, {"gyro_b.scale", "B"}, {}, {}}}},
    Group{"Gyros: bias",
          "deg/s",
          base::kDegreesPerRadian,
          {{{"gyro.bias_rad_s", "A"}, {"gyro_b.bias_rad_s", "B"}, {}, {}}}},
    Group{"Compass deviation",
          "degrees",
          base::kDegreesPerRadian,
          {{{"compass.B_rad", "B"}, {"compass.C_rad", "C"}, {"compass.D_rad", "D"}, {"compass.E_rad", "E"}}}},
    Group{"Magnetometer: offset",
          "uT",
          1,
          {{{"magnetometer.offset_x_uT", "forward"},
            {"magnetometer.offset_y_uT", "starboard"},
            {"magnetometer.offset_z_uT", "down"},
            {}}}},
    Group{"Misalignment",
          "degrees",
          base::kDegreesPerRadian,
          {{{"misalignment.A_rad", "A"}, {"gps_compass.A_rad", "A with B to E"}, {}, {}}}},
    Group{"Delay of the compass", "milliseconds", 1000, {{{"compass_delay.delay_s", "delay"}, {}, {}, {}}}},
};
constexpr std::array kCalibratorInks{Ink::first, Ink::second, Ink::third, Ink::fourth};

/// Error, as a multiple of the final one, above which an estimate is treated as not supported for a while.
constexpr double kMuchWorse = 5;

/// Values that the second half of the time needs. The first estimates scatter widely, and a short time of poor
/// support would compress the rest.
Range late_range(const std::vector<std::span<const analysis::EstimatePoint>>& curves, double factor) {
  double least = INFINITY, most = -INFINITY;
  for (const auto curve : curves) {
    for (const analysis::EstimatePoint& point : curve.subspan(curve.size() / 2)) {
      if (!(point.std <= kMuchWorse * curve.back().std)) continue;
      least = std::min(least, (point.value - 2 * point.std) * factor);
      most = std::max(most, (point.value + 2 * point.std) * factor);
    }
  }
  const double margin = std::max(0.4 * (most - least), 1e-9 + 1e-4 * std::abs(most));
  return {least - margin, most + margin};
}

/// Times count from the first estimate of any curve.
EarlyTimeAxis time_axis(const std::vector<std::span<const analysis::EstimatePoint>>& curves) {
  double first_s = INFINITY, last_s = 0;
  for (const auto curve : curves) {
    const auto first = std::ranges::find_if(curve, [](const analysis::EstimatePoint& point) {
      return std::isfinite(point.value) && std::isfinite(point.std);
    });
    if (first != curve.end()) first_s = std::min(first_s, first->time_s);
    last_s = std::max(last_s, curve.back().time_s);
  }
  return EarlyTimeAxis({std::min(first_s, last_s), last_s});
}

/// Points with an error. The others are not determined, and shown as zero.
std::size_t determined(const std::vector<analysis::EstimatePoint>& points) {
  return static_cast<std::size_t>(std::ranges::count_if(
      points, [](const analysis::EstimatePoint& point) { return std::isfinite(point.std); }));
}

void draw(SvgPlot& plot, Ink ink, const char* name, std::span<const analysis::EstimatePoint> curve,
          const EarlyTimeAxis& time, double factor) {
  std::vector<Point> line, lower, upper;
  for (const analysis::EstimatePoint& point : curve) {
    if (!std::isfinite(point.std)) continue;
    const double t = time(point.time_s);
    line.push_back({t, point.value * factor});
    lower.push_back({t, (point.value - 2 * point.std) * factor});
    upper.push_back({t, (point.value + 2 * point.std) * factor});
  }
  plot.band(ink, "", lower, upper);
  plot.line(ink, name, line);
}

}  // namespace

std::vector<Figure> convergence_figures(const analysis::CalibrateHistory::Estimates& estimates) {
  std::vector<Figure> figures;
  for (const Group& group : kGroups) {
    std::vector<std::span<const analysis::EstimatePoint>> curves;
    std::vector<const char*> names;
    for (const Curve& curve : group.curves) {
      const auto found = curve.estimate != nullptr ? estimates.find(curve.estimate) : estimates.end();
      if (found == estimates.end() || determined(found->second) < kLeastPoints) continue;
      if (!std::isfinite(found->second.back().std)) continue;
      curves.emplace_back(found->second);
      names.push_back(curve.name);
    }
    if (curves.empty()) continue;
    const EarlyTimeAxis time = time_axis(curves);
    SvgPlot plot(group.title, time.axis(), {group.unit, late_range(curves, group.factor)});
    for (std::size_t i = 0; i < curves.size(); ++i)
      draw(plot, kCalibratorInks[i], names[i], curves[i], time, group.factor);
    figures.push_back({group.title, plot.svg(),
                       "With two standard errors to either side; large errors of the first estimates are outside "
                       "the plot. The first minute is enlarged."});
  }
  return figures;
}

}  // namespace navcal::report
