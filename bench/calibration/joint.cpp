// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "bench/calibration/turn_tables.h"
#include "calib/thesis/turn_problem.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::bench {

using namespace calib::thesis;
using calib::test::load_true_path;

namespace {

/// THESIS 11.3, best method there, with noise: largest / standard deviation in degrees; percent of scale / bias.
constexpr double kThere[8][4] = {{0.12, 0.07, 0.81, 3.20}, {0.10, 0.06, 0.06, 0.24}, {1.22, 0.80, 1.33, 1.45},
                                 {7.42, 4.96, 8.76, 8.78}, {0.07, 0.04, 0.05, 0.27}, {0.08, 0.04, 0.05, 0.27},
                                 {0.06, 0.03, 0.43, 3.30}, {0.29, 0.17, 1.83, 3.93}};

}  // namespace

void print_joint(const TableOptions& options) {
  std::puts(
      "Neither gyro nor compass calibrated. Curve: error of the deviation over the whole circle, degrees, largest "
      "/\n"
      "standard deviation, means over the runs. Paths 3 and 4 see 220 and 180 degrees.\n\n"
      "| path | no noise: scale / bias, % | no noise: curve | least squares (THESIS): curve | ours: curve | least "
      "squares "
      "(THESIS): scale / bias, % | ours: scale / bias, % | bound | ratio | covered, % | condition | reduced chi2 "
      "| "
      "misses |\n|-|-|-|-|-|-|-|-|-|-|-|-|-|");
  double covered = 0;
  for (int p = 0; p < 8; ++p) {
    const auto path = load_true_path(fmt::format("path{}", p + 1));
    Random none(1);
    const calib::TurnFilter clean = filtered(TurnProblem::both, measure(TurnProblem::both, path, kNoNoise, none));
    const calib::TurnCoefficients error = clean.estimate() - true_coefficients(TurnProblem::both);
    const double scale = std::abs(100 * error[0] / kTrueScale), bias = std::abs(100 * error[1] / kTrueBias_rad_s);
    const double curve = curve_error(error.tail<4>()).largest_deg;
    const TurnStatistics noisy = monte_carlo(TurnProblem::both, path, options.runs, static_cast<unsigned>(p) + 1);
    covered += noisy.covered.mean() / 8;
    std::string misses;
    if (scale > 0.005 || bias > 0.02 || curve > 0.03) misses += "no noise ";
    if (noisy.worst_ratio() > 1.1) misses += "ratio ";
    const auto percent = [](const Eigen::VectorXd& v) {
      return fmt::format("{:.3f} / {:.3f}", 100 * v[0] / kTrueScale, -100 * v[1] / kTrueBias_rad_s);
    };
    std::puts(
        fmt::format(
            "| {} | {:.4f} / {:.4f} | {:.4f} | {} / {} | {:.3f} / {:.3f} | {} / {} | {} | {} | {:.3f} | {:.1f} "
            "| {:.3g} | {:.3f} | {} |",
            p + 1, scale, bias, curve, kThere[p][0], kThere[p][1], noisy.curve.largest_deg,
            noisy.curve.deviation_deg, kThere[p][2], kThere[p][3], percent(noisy.rms), percent(noisy.bound),
            noisy.worst_ratio(), 100 * noisy.covered.mean(), clean.condition(), noisy.reduced_chi_squared, misses)
            .c_str());
  }
  std::puts(fmt::format("\nCovered, all paths: {:.2f} % (goal 94 to 97).", 100 * covered).c_str());
}

}  // namespace navcal::bench
