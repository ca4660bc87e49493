// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "report/shown_number.h"
#include "report/svg_plot.h"

namespace navcal::report {

/// Axis of headings that is cut open at the least visited heading, so that a course about north does not jump from
/// the top to the bottom. Marks are N, NE, E and so on. Degrees.
class HeadingAxis {
 public:
  /// All headings to be shown.
  explicit HeadingAxis(const std::vector<double>& headings_deg);

  /// The heading within the axis.
  [[nodiscard]] double operator()(double heading_deg) const;
  [[nodiscard]] SvgPlot::Axis axis(std::string label) const;

 private:
  double least_deg_ = 0;
};

/// Times from the first on, in the unit that suits their length.
class TimeAxis {
 public:
  /// In seconds, increasing.
  explicit TimeAxis(const std::vector<double>& times_s) {
    if (times_s.empty()) return;
    first_s_ = times_s.front();
    length_s_ = std::max(times_s.back() - first_s_, 1e-3);
    if (length_s_ > 3 * 3600) {
      unit_s_ = 3600;
      label_ = "hours";
    } else if (length_s_ > 600) {
      unit_s_ = 60;
      label_ = "minutes";
    }
  }
  [[nodiscard]] double operator()(double time_s) const { return (time_s - first_s_) / unit_s_; }
  [[nodiscard]] SvgPlot::Axis axis() const { return {label_, {0, length_s_ / unit_s_}}; }

 private:
  double first_s_ = 0, length_s_ = 1, unit_s_ = 1;
  std::string label_ = "seconds";
};

/// Times since the first one on a scale whose first minute is as long as the four after it: t is at log(1 + t / 20
/// s). For quantities that change much at first and little later.
class EarlyTimeAxis {
 public:
  /// In seconds from the beginning of the recording, increasing.
  explicit EarlyTimeAxis(const std::vector<double>& times_s) {
    if (times_s.empty()) return;
    first_s_ = times_s.front();
    length_s_ = std::max(times_s.back() - first_s_, 1e-3);
  }
  [[nodiscard]] double operator()(double time_s) const { return std::log1p((time_s - first_s_) / kEarly_s); }
  [[nodiscard]] SvgPlot::Axis axis() const {
    SvgPlot::Axis axis{"time since the first estimate", {0, (*this)(first_s_ + length_s_)}};
    if (first_s_ > 0) axis.label += ", " + duration_text(first_s_) + " from the beginning";
    double last = -1;
    for (const auto& [time_s, text] : kTicks) {
      const double place = (*this)(first_s_ + time_s);
      if (time_s > length_s_ || place - last < kApart * axis.range.most) continue;
      axis.ticks.push_back({place, text});
      last = place;
    }
    return axis;
  }

 private:
  static constexpr double kEarly_s = 20, kApart = 0.07;
  static constexpr std::array<std::pair<double, const char*>, 14> kTicks{{{0, "0"},
                                                                          {10, "10 s"},
                                                                          {20, "20 s"},
                                                                          {40, "40 s"},
                                                                          {60, "1 min"},
                                                                          {120, "2 min"},
                                                                          {300, "5 min"},
                                                                          {600, "10 min"},
                                                                          {1200, "20 min"},
                                                                          {3600, "1 h"},
                                                                          {7200, "2 h"},
                                                                          {18000, "5 h"},
                                                                          {43200, "12 h"},
                                                                          {86400, "24 h"}}};

  double first_s_ = 0, length_s_ = 1;
};

}  // namespace navcal::report
