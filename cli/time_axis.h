#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "cli/svg_plot.h"

namespace navcal::cli {

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

}  // namespace navcal::cli
