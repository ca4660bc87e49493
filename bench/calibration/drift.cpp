// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/calibration/turn_tables.h"
#include "calib/thesis/turn_problem.h"
#include "calib/turn/turn_integrator.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::bench {

using namespace calib;
using namespace calib::thesis;
using calib::test::load_true_path;

namespace {

constexpr double kFromDegreesPerMinute = std::numbers::pi / 180 / 60;
constexpr double kRamp_rad_s2 = 5 * kFromDegreesPerMinute / 60;

/// Error of the bias at the end, degrees/minute, of one run along the long path.
double final_error(const std::vector<TruePoint>& path, double walk, Random& random, double& standard_error) {
  TurnFilter::Parameters parameters;
  parameters.heading_noise_rad = Noise{}.heading_rad;
  parameters.rate_noise_rad_sqrt_s = Noise{}.rate_rad_s * std::sqrt(0.1);
  parameters.bias_walk_rad_s_sqrt_s = walk;
  TurnFilter filter(parameters, TurnPrior::unknown_gyro());
  TurnIntegrator integrator({});
  for (const Measured& m : measure(TurnProblem::gyro, path, Noise{}, random)) {
    RateReading rate = rate_of(m);
    rate.rate_rad_s.z() -= kRamp_rad_s2 * m.time_s / kTrueScale;
    integrator.update(compass_of(m));
    integrator.update(rate);
    while (const auto step = integrator.next()) filter.update(*step);
  }
  standard_error = std::sqrt(filter.covariance()(kBias, kBias)) / kFromDegreesPerMinute;
  const double truth = kTrueBias_rad_s + kRamp_rad_s2 * path.back().time_s;
  return (filter.estimate()[kBias] - truth) / kFromDegreesPerMinute;
}

}  // namespace

void print_drift(const TableOptions& options) {
  std::puts(
      "Bias of the gyro rising by 5 degrees/minute each minute for ten minutes (path_long600, noise of the "
      "thesis).\n"
      "Error at the end, degrees/minute.\n\n| bias walk, rad/s/sqrt(s) | root-mean-square | goal | mean standard "
      "error | "
      "misses |\n|-|-|-|-|-|");
  const auto path = load_true_path("path_long600");
  const int runs = std::min(options.runs, 100);
  for (const double walk : {0.0, 1e-4, 3e-4}) {
    Random random(3);
    double square = 0, stated = 0;
    for (int run = 0; run < runs; ++run) {
      double standard_error = 0;
      square += std::pow(final_error(path, walk, random, standard_error), 2) / runs;
      stated += standard_error / runs;
    }
    const double rms = std::sqrt(square);
    std::puts(fmt::format("| {:g} | {:.2f} | {} | {:.2f} | {} |", walk, rms, walk > 0 ? "2" : "", stated,
                          walk > 0 && rms > 2 ? "goal" : "")
                  .c_str());
  }
}

}  // namespace navcal::bench
