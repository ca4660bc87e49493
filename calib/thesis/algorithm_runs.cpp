// SPDX-License-Identifier: Apache-2.0
#include "calib/thesis/algorithm_runs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "calib/thesis/adaptive_identifier.h"
#include "calib/thesis/heading_least_squares.h"

namespace navcal::calib::thesis {

namespace {

/// The algorithms of the thesis do not unwrap.
template <class Estimator, class Use>
Estimator run(std::span<const Measured> readings, Use use) {
  Estimator estimator(kPeriod_s);
  double unwrapped = readings.empty() ? 0 : readings.front().heading_rad;
  for (const Measured& m : readings) {
    unwrapped += std::remainder(m.heading_rad - unwrapped, 2 * std::numbers::pi);
    use(estimator, m, unwrapped);
  }
  return estimator;
}

}  // namespace

Eigen::Vector2d thesis_gyro(std::span<const Measured> readings) {
  const auto estimator = run<GyroLeastSquares>(readings, [](auto& e, const Measured& m, double heading_rad) {
    e.update(heading_rad, m.roll_rad, m.pitch_rad, m.rate_rad_s.z());
  });
  return estimator.estimate().value_or(Eigen::Vector2d::Zero());
}

Eigen::Vector2d thesis_adaptive(std::span<const Measured> readings) {
  const auto estimator = run<AdaptiveIdentifier>(readings, [](auto& e, const Measured& m, double heading_rad) {
    e.update(heading_rad, m.roll_rad, m.pitch_rad, m.rate_rad_s.z());
  });
  return estimator.estimate();
}

Eigen::Vector4d thesis_compass(std::span<const Measured> readings) {
  const auto estimator = run<CompassLeastSquares>(readings, [](auto& e, const Measured& m, double heading_rad) {
    const double rate = kTrueScale * m.rate_rad_s.z() + kTrueBias_rad_s;
    e.update(heading_rad, std::cos(m.roll_rad) / std::cos(m.pitch_rad) * rate);
  });
  return estimator.estimate().value_or(Eigen::Vector4d::Zero());
}

double table_4_1_heading_rad(double true_heading_rad) {
  return true_heading_rad - deviation_rad(thesis_deviation(), true_heading_rad);
}

Eigen::Vector4d table_4_1_compass(std::span<const TruePoint> path) {
  CompassLeastSquares estimator(kPeriod_s);
  for (const TruePoint& p : path) {
    estimator.update(table_4_1_heading_rad(p.heading_rad),
                     std::cos(p.roll_rad) / std::cos(p.pitch_rad) * p.rate_rad_s.z());
  }
  // The thesis adds this deviation to the reading, (2.8) subtracts it.
  return -estimator.estimate().value_or(Eigen::Vector4d::Zero());
}

double table_4_1_error_rad(const Eigen::Vector4d& deviation, double true_heading_rad) {
  Deviation estimate = Deviation::Zero();
  estimate.tail<4>() = deviation;
  const double measured = table_4_1_heading_rad(true_heading_rad);
  return measured + deviation_rad(estimate, measured) - true_heading_rad;
}

HeadingStatistics table_4_1_statistics(const Eigen::Vector4d& deviation) {
  HeadingStatistics statistics;
  double sum = 0, square = 0;
  for (int k = 0; k < kCirclePoints; ++k) {
    const double error = table_4_1_error_rad(deviation, 0.01 * k) * base::kDegreesPerRadian;
    statistics.largest_deg = std::max(statistics.largest_deg, std::abs(error));
    sum += error;
    square += error * error;
  }
  statistics.mean_deg = sum / kCirclePoints;
  statistics.std_deg = std::sqrt((square - sum * sum / kCirclePoints) / (kCirclePoints - 1));
  return statistics;
}

}  // namespace navcal::calib::thesis
