// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_bank.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

#include "gap/inference/biases.h"
#include "gap/nulls/simulate_feasible.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

struct Null {
  Innovations nominal;
  Layout layout;
  Trajectory10Hz course;
  std::vector<double> fix_times_s;
  std::optional<Innovations> noise;  ///< by its own true parameters
};

/// Simulates a vehicle within tolerance that repeats the recorded mission. `with_noise`: also replays it with
/// its own true parameters.
Null simulate_null(const RepeatedMission& repeated, const Library& library, std::uint64_t seed, bool with_noise) {
  const Model truth = library.model(benign_mismatch(library, seed));
  const Mission mission = null_mission(repeated, truth.effects, seed);
  const Replay replay(mission, repeated.vehicle);
  Null null;
  null.layout = layout_of(replay);
  null.fix_times_s = mission.fix_times_s();
  null.nominal = replay.run(Model{}, &null.course);
  if (with_noise) null.noise = replay.run(truth);
  return null;
}

/// Fits the whitening filter, and the statistics of the residuals that exact models leave. Moves the noise out
/// of `nulls`.
void learn_noise(std::vector<Null>& nulls, NullBank& bank) {
  std::vector<Innovations> noise;
  std::vector<Layout> layouts;
  std::vector<Eigen::MatrixXd> left_by_nulls;
  for (Null& null : nulls) {
    if (!null.noise) continue;
    left_by_nulls.push_back(explained_rms(*null.noise, null.course, null.fix_times_s));
    noise.push_back(std::move(*null.noise));
    layouts.push_back(null.layout);
  }
  bank.whitening = Whitening(noise, layouts);
  bank.left = RegimeStatistics(left_by_nulls);
}

/// Scores and powers of the nulls with the recorded mission's design. It serves all of them because they were
/// steered alike.
void score_nulls(const std::vector<Null>& nulls, const Linearised& linear, const Layout& layout, NullBank& bank) {
  bank.gram = linear.gram;
  bank.scores.resize(linear.gram.rows(), static_cast<Eigen::Index>(nulls.size()));
  const auto biases = bias_factor(linear.gram);
  std::vector<Eigen::MatrixXd> explained_by_nulls;
  for (std::size_t i = 0; i < nulls.size(); ++i) {
    const Null& null = nulls[i];
    const Eigen::VectorXd white = bank.whitening(fitted_into(null.nominal, layout), layout);
    const auto column = static_cast<Eigen::Index>(i);
    bank.scores.col(column) = linear.design.transpose() * white;
    const Eigen::VectorXd bias = biases.solve(bank.scores.col(column).head<Library::kBiases>());
    const Eigen::VectorXd left = white - linear.design.leftCols(Library::kBiases) * bias;
    bank.powers.push_back(left.squaredNorm() / static_cast<double>(Whitening::count(left)));
    explained_by_nulls.push_back(explained_rms(null.nominal, null.course, null.fix_times_s));
  }
  bank.explained_rms = RegimeStatistics(explained_by_nulls);
}

}  // namespace

Innovations fitted_into(const Innovations& innovations, const Layout& layout) {
  const auto shaped = [](const Eigen::MatrixXd& from, Eigen::Index rows) {
    Eigen::MatrixXd to = Eigen::MatrixXd::Constant(rows, from.cols(), std::numeric_limits<double>::quiet_NaN());
    const Eigen::Index both = std::min(rows, from.rows());
    to.topRows(both) = from.topRows(both);
    return to;
  };
  Innovations result;
  result.grid = shaped(innovations.grid, layout.intervals);
  result.fixes = shaped(innovations.fixes, static_cast<Eigen::Index>(layout.fix_numbers.size()));
  return result;
}

NullBank make_null_bank(const RepeatedMission& repeated, const Library& library, const Eigen::VectorXd& at,
                        const BankOptions& options, const std::function<void(double)>& progress) {
  const auto began = std::chrono::steady_clock::now();
  NullBank bank;
  bank.seed = options.seed;
  auto nulls = simulate_feasible(
      options, Seeds::bank,
      [&](std::size_t i, std::uint64_t seed) {
        return simulate_null(repeated, library, seed, i < kWhiteningMissions);
      },
      [&](double share) { progress(0.95 * share); });
  bank.missions = static_cast<int>(nulls.size());
  if (nulls.empty()) return bank;
  learn_noise(nulls, bank);
  const Linearised linear = linearise({repeated.recorded, library, bank.whitening, options.threads}, at);
  score_nulls(nulls, linear, layout_of(repeated.recorded), bank);
  bank.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  progress(1);
  return bank;
}

}  // namespace navcal::gap
