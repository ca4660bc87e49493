// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration/thesis_runs.h"

#include <cmath>
#include <numbers>

#include "calib/thesis/adaptive_identifier.h"
#include "calib/thesis/compass_least_squares.h"
#include "calib/thesis/gyro_least_squares.h"

namespace navcal::bench {

using calib::test::Measured;

namespace {

constexpr double kPeriod_s = 0.1;

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
  using calib::thesis::GyroLeastSquares;
  const auto estimator = run<GyroLeastSquares>(readings, [](auto& e, const Measured& m, double heading_rad) {
    e.update(heading_rad, m.roll_rad, m.pitch_rad, m.rate_rad_s.z());
  });
  return estimator.estimate().value_or(Eigen::Vector2d::Zero());
}

Eigen::Vector2d thesis_adaptive(std::span<const Measured> readings) {
  using calib::thesis::AdaptiveIdentifier;
  const auto estimator = run<AdaptiveIdentifier>(readings, [](auto& e, const Measured& m, double heading_rad) {
    e.update(heading_rad, m.roll_rad, m.pitch_rad, m.rate_rad_s.z());
  });
  return estimator.estimate();
}

Eigen::Vector4d thesis_compass(std::span<const Measured> readings) {
  using calib::thesis::CompassLeastSquares;
  const auto estimator = run<CompassLeastSquares>(readings, [](auto& e, const Measured& m, double heading_rad) {
    const double rate = calib::test::kTrueScale * m.rate_rad_s.z() + calib::test::kTrueBias_rad_s;
    e.update(heading_rad, std::cos(m.roll_rad) / std::cos(m.pitch_rad) * rate);
  });
  return estimator.estimate().value_or(Eigen::Vector4d::Zero());
}

}  // namespace navcal::bench
