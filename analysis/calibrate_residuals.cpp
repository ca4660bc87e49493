// SPDX-License-Identifier: Apache-2.0
#include "analysis/calibrate_residuals.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace navcal::analysis {
namespace {

/// Long enough to turn far, short enough that the gyro's drift does not show.
constexpr double kBlock_s = 20, kEnoughTurn_rad = 1, kLeastTurn_rad = 0.5, kLongestBlock_s = 60;
constexpr std::size_t kLeastSamples = 8;

/// Samples that follow each other without a gap.
class Block {
 public:
  explicit Block(const calib::Correction& estimates) : estimates_(estimates) {}

  void add(const TurnedSample& sample, double turn_rad) {
    const auto& reading = sample.reading;
    const double heading_rad = *reading.heading_rad;
    const double after_rad = calib::best_heading(estimates_, reading).value_or(heading_rad);
    if (residuals_.empty()) {
      first_before_rad_ = heading_rad - turn_rad;
      first_after_rad_ = after_rad - turn_rad;
      begin_s_ = reading.time_s;
      least_rad_ = most_rad_ = turn_rad;
    }
    least_rad_ = std::min(least_rad_, turn_rad);
    most_rad_ = std::max(most_rad_, turn_rad);
    end_s_ = reading.time_s;
    const double curve_rad =
        estimates_.compass ? base::wrapped(heading_rad - (*estimates_.compass)(heading_rad)) : 0;
    // From the first on, so that a residual near half a turn is no leap.
    residuals_.push_back({heading_rad, base::wrapped(heading_rad - turn_rad - first_before_rad_),
                          base::wrapped(after_rad - turn_rad - first_after_rad_), curve_rad});
  }

  [[nodiscard]] bool long_enough() const {
    const double took_s = end_s_ - begin_s_;
    return took_s > kLongestBlock_s || (took_s > kBlock_s && most_rad_ - least_rad_ > kEnoughTurn_rad);
  }

  void end(std::vector<HeadingResidual>& out) {
    if (residuals_.size() >= kLeastSamples && most_rad_ - least_rad_ >= kLeastTurn_rad) {
      const double before = mean(&HeadingResidual::before_rad), after = mean(&HeadingResidual::after_rad);
      const double curve = mean(&HeadingResidual::deviation_rad);
      for (HeadingResidual residual : residuals_) {
        residual.before_rad -= before;
        residual.after_rad -= after;
        residual.deviation_rad = residual.before_rad + curve;
        out.push_back(residual);
      }
    }
    residuals_.clear();
  }

 private:
  [[nodiscard]] double mean(double HeadingResidual::*which) const {
    double sum = 0;
    for (const auto& residual : residuals_) sum += residual.*which;
    return sum / static_cast<double>(residuals_.size());
  }

  const calib::Correction& estimates_;
  std::vector<HeadingResidual> residuals_;
  double first_before_rad_ = 0, first_after_rad_ = 0;
  double begin_s_ = 0, end_s_ = 0, least_rad_ = 0, most_rad_ = 0;
};

}  // namespace

std::vector<HeadingResidual> heading_residuals(const std::vector<TurnedSample>& samples,
                                               const calib::Correction& estimates) {
  std::vector<HeadingResidual> residuals;
  if (!estimates.gyro) return residuals;
  const bool needs_field = estimates.magnetometer.has_value();
  Block block(estimates);
  double turn_rad = 0;
  for (const TurnedSample& sample : samples) {
    if (!sample.has_turn || block.long_enough()) block.end(residuals);
    turn_rad = sample.has_turn ? turn_rad + estimates.gyro->scale * sample.measured_rad +
                                     estimates.gyro->bias_rad_s * sample.bias_time_s + sample.tilt_rad
                               : 0;
    if (sample.reading.heading_rad && (!needs_field || sample.reading.field_body_uT)) block.add(sample, turn_rad);
  }
  block.end(residuals);
  return residuals;
}

double root_mean_square(const std::vector<HeadingResidual>& residuals, double HeadingResidual::*which) {
  double sum = 0;
  for (const auto& residual : residuals) sum += residual.*which * (residual.*which);
  return residuals.empty() ? 0 : std::sqrt(sum / static_cast<double>(residuals.size()));
}

}  // namespace navcal::analysis
