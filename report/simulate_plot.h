// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/simulate_history.h"
#include "report/svg_plot.h"
#include "report/time_axis.h"

namespace navcal::report {

/// Curves over the time of a mission; dots are drawn below lines.
class SimulatedPlot {
 public:
  explicit SimulatedPlot(const std::vector<analysis::Timed<sim::State>>& states) : time_(times_of(states)) {}

  /// A value of each element; absent ones are left out.
  template <class Value, class Get>
  SimulatedPlot& dots(SvgPlot::Ink ink, const char* name, const std::vector<analysis::Timed<Value>>& list,
                      Get get) {
    dots_.push_back({ink, name, points_of(list, get)});
    return *this;
  }
  template <class Value, class Get>
  SimulatedPlot& line(SvgPlot::Ink ink, const char* name, const std::vector<analysis::Timed<Value>>& list,
                      Get get) {
    lines_.push_back({ink, name, points_of(list, get)});
    return *this;
  }

  /// Empty without values.
  [[nodiscard]] std::string svg(const char* title, const char* unit) const {
    std::vector<double> values;
    for (const auto* curves : {&dots_, &lines_}) {
      for (const Curve& curve : *curves) {
        for (const Point& point : curve.points) values.push_back(point.y);
      }
    }
    if (values.empty()) return {};
    SvgPlot plot(title, time_.axis(), {unit, whole_range_of(values)});
    for (const Curve& curve : dots_) plot.points(curve.ink, curve.name, curve.points);
    for (const Curve& curve : lines_) plot.line(curve.ink, curve.name, curve.points);
    return plot.svg();
  }

 private:
  struct Curve {
    SvgPlot::Ink ink;
    const char* name;
    std::vector<Point> points;
  };
  static std::vector<double> times_of(const std::vector<analysis::Timed<sim::State>>& states) {
    if (states.empty()) return {};
    return {states.front().time_s, states.back().time_s};
  }
  template <class Value, class Get>
  std::vector<Point> points_of(const std::vector<analysis::Timed<Value>>& list, Get get) const {
    std::vector<Point> points;
    for (const analysis::Timed<Value>& element : list) {
      const std::optional<double> value = get(element.value);
      if (value) points.push_back({time_(element.time_s), *value});
    }
    return points;
  }

  TimeAxis time_;
  std::vector<Curve> dots_, lines_;
};

}  // namespace navcal::report
