// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "bench/calibration/turn_tables.h"
#include "calib/thesis/algorithm_runs.h"
#include "calib/thesis/turn_problem.h"
#include "tests/calib/thesis_paths.h"

namespace navcal::bench {

using namespace calib::thesis;
using calib::test::load_true_path;

namespace {

/// Table 3.1, |%|.
constexpr double kThesis[8][2] = {{1.93, 8.47}, {0.48, 0.71}, {0.47, 0.62},  {0.65, 0.89},
                                  {3.66, 3.41}, {2.64, 2.51}, {3.40, 34.39}, {2.08, 4.60}};
/// THESIS 11.1: without noise on every path, then with noise.
constexpr double kGoalWithoutNoise[2] = {0.005, 0.02};
constexpr double kGoal[8][2] = {{0.98, 3.86}, {0.08, 0.28}, {0.08, 0.30}, {0.08, 0.30},
                                {0.06, 0.35}, {0.06, 0.37}, {0.54, 4.19}, {2.16, 4.65}};

/// Errors of scale and bias, in percent of the injected ones.
Eigen::Vector2d percent(const Eigen::Vector2d& error) {
  return 100 * Eigen::Vector2d(error[0] / kTrueScale, error[1] / kTrueBias_rad_s).cwiseAbs();
}

Eigen::Vector2d thesis_rms(const std::vector<TruePoint>& path, int runs) {
  Random random(7);
  Eigen::Vector2d square = Eigen::Vector2d::Zero();
  for (int run = 0; run < runs; ++run) {
    const auto readings = measure(TurnProblem::gyro, path, Noise{}, random);
    square += percent(thesis_gyro(readings) - Eigen::Vector2d(kTrueScale, kTrueBias_rad_s)).cwiseAbs2() / runs;
  }
  return square.cwiseSqrt();
}

std::string pair(const Eigen::Vector2d& v, int digits) {
  return fmt::format("{:.{}f} / {:.{}f}", v[0], digits, v[1], digits);
}

}  // namespace

void print_gyro(const TableOptions& options) {
  const Eigen::Vector2d truth(kTrueScale, kTrueBias_rad_s);
  std::puts(
      "Percent of scale / bias. Noise: root-mean-square over the runs. Bound: Cramer-Rao of that path. Covered: "
      "runs\n"
      "with the truth within two standard errors.\n\n"
      "| path | thesis LS (3.1) | our run of it | our run of the adaptive identifier | ours, no noise | thesis "
      "LS, "
      "noise | ours, noise | bound | ratio | goal | covered, % | reduced chi2 | misses "
      "|\n|-|-|-|-|-|-|-|-|-|-|-|-|-|");
  double covered = 0;
  for (int p = 0; p < 8; ++p) {
    const auto path = load_true_path(fmt::format("path{}", p + 1));
    Random none(1);
    const auto clean = measure(TurnProblem::gyro, path, kNoNoise, none);
    const Eigen::Vector2d adaptive = thesis_adaptive(clean) - truth;
    const Eigen::Vector2d ours =
        percent(filtered(TurnProblem::gyro, clean).estimate().head<2>() - truth.head<2>());
    const TurnStatistics noisy = monte_carlo(TurnProblem::gyro, path, options.runs, static_cast<unsigned>(p) + 1);
    const Eigen::Vector2d rms = percent(noisy.rms);
    covered += noisy.covered.mean() / 8;
    std::string misses;
    if ((ours.array() > Eigen::Array2d(kGoalWithoutNoise[0], kGoalWithoutNoise[1])).any()) misses += "no noise ";
    if (noisy.worst_ratio() > 1.1) misses += "ratio ";
    if ((rms.array() > Eigen::Array2d(kGoal[p][0], kGoal[p][1])).any()) misses += "goal ";
    std::puts(fmt::format("| {} | {} / {} | {} | {:.2f} / {:.2f} | {} | {} | {} | {} | {:.3f} | {} / {} | {:.1f} "
                          "| {:.3f} | {} |",
                          p + 1, kThesis[p][0], kThesis[p][1], pair(percent(thesis_gyro(clean) - truth), 2),
                          100 * adaptive[0] / kTrueScale, -100 * adaptive[1] / kTrueBias_rad_s, pair(ours, 4),
                          pair(thesis_rms(path, options.runs), 2), pair(rms, 3), pair(percent(noisy.bound), 3),
                          noisy.worst_ratio(), kGoal[p][0], kGoal[p][1], 100 * noisy.covered.mean(),
                          noisy.reduced_chi_squared, misses)
                  .c_str());
  }
  std::puts(fmt::format("\nCovered, all paths: {:.2f} % (goal 94 to 97).", 100 * covered).c_str());
}

}  // namespace navcal::bench
