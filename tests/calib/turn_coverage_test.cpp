#include <gtest/gtest.h>

#include <cmath>

#include "calib/turn_filter.h"
#include "calib/turn_integrator.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

TurnFilter filtered(const std::vector<Measured>& readings, const TurnPrior& prior) {
  TurnFilter::Parameters parameters;
  parameters.heading_noise_rad = Noise{}.heading_rad;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(0.1);
  TurnFilter filter(parameters, prior);
  TurnIntegrator integrator({});
  for (const Measured& m : readings) {
    CompassReading compass;
    compass.time_s = m.time_s;
    compass.heading_rad = m.heading_rad;
    compass.roll_rad = m.roll_rad;
    compass.pitch_rad = m.pitch_rad;
    RateReading rate;
    rate.time_s = m.time_s;
    rate.rate_rad_s = m.rate_rad_s;
    integrator.update(compass);
    integrator.update(rate);
    while (const auto step = integrator.next()) filter.update(*step);
  }
  return filter;
}

TEST(TurnCoverage, WithoutNoiseTheGoalsOfTheGyroOnEveryPath) {
  for (int p = 1; p <= 8; ++p) {
    Random random(1);
    const auto readings = measure(load_true_path("path" + std::to_string(p)), Deviation::Zero(), kNoNoise, random);
    const TurnCoefficients found = filtered(readings, TurnPrior::unknown_gyro()).estimate();
    EXPECT_NEAR(found[kScale] / kTrueScale, 1, 0.005 / 100) << p;
    EXPECT_NEAR(found[kBias] / kTrueBias_rad_s, 1, 0.02 / 100) << p;
  }
}

TEST(TurnCoverage, TwoStandardErrorsCoverTheTruthOnFullAndHalfCircles) {
  TurnCoefficients truth;
  truth << kTrueScale, kTrueBias_rad_s, thesis_deviation().tail<4>();
  constexpr int kRuns = 25;
  int covered = 0;
  for (const char* name : {"path2", "path4"}) {
    const auto path = load_true_path(name);
    Random random(11);
    for (int run = 0; run < kRuns; ++run) {
      const TurnFilter filter =
          filtered(measure(path, thesis_deviation(), Noise{}, random), TurnPrior::unknown_both());
      const TurnCovariance covariance = filter.covariance();
      for (int i = 0; i < 6; ++i) {
        if (std::abs(filter.estimate()[i] - truth[i]) < 2 * std::sqrt(covariance(i, i))) ++covered;
      }
    }
  }
  // Of 300, but errors of one run go together: the limits are those of fifty.
  EXPECT_GT(covered, 300 * 0.82);
}

}  // namespace
}  // namespace navcal::calib
