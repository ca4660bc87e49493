// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/holdout.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "gap/inference/biases.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Innovations with these effects and the biases fitted to them, and their whitened form.
struct Fitted {
  Innovations innovations;
  Eigen::VectorXd white;
};

Fitted fitted(const ResidualModel& model, Eigen::VectorXd values, Trajectory10Hz* course) {
  values = with_biases_fitted(model, std::move(values));
  Fitted result;
  result.innovations = model.replay.run(model.library.model(values), course);
  result.white = model.whitening(result.innovations, layout_of(model.replay));
  return result;
}

std::vector<double> blocks(const Eigen::VectorXd& white, const Layout& layout) {
  const auto length = static_cast<Eigen::Index>(kBlock_s / kInterval_s) * kEvidenceChannels;
  const Eigen::Index grid = layout.intervals * kEvidenceChannels;
  std::vector<double> sums;
  for (Eigen::Index from = 0; from < grid; from += length) {
    sums.push_back(white.segment(from, std::min(length, grid - from)).squaredNorm());
  }
  // Ten fixes make one block: one outlying surfacing is one event.
  constexpr Eigen::Index kFixes = 10 * kFixChannels;
  for (Eigen::Index from = grid; from < white.size(); from += kFixes) {
    sums.push_back(white.segment(from, std::min(kFixes, white.size() - from)).squaredNorm());
  }
  return sums;
}

Power power_of(const Eigen::VectorXd& white, const Layout& layout) {
  return {white.squaredNorm() / static_cast<double>(Whitening::count(white)), blocks(white, layout)};
}

/// The floor of several missions together, and the number of their measurements.
struct PooledFloor {
  double mean = 0, std = 0, measurements = 0;
};

/// Closures of a bootstrap that resamples the blocks and draws the floor. Resamples without a gap are left out.
std::vector<double> resampled_closures(const std::vector<Comparison>& comparisons, const std::vector<Power>& after,
                                       const PooledFloor& floor) {
  std::mt19937_64 dice(1);
  std::normal_distribution<double> normal;
  std::vector<double> closures;
  for (int n = 0; n < kResamples; ++n) {
    double was = 0, is = 0;
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
      const auto& blocks = comparisons[i].before.blocks;
      std::uniform_int_distribution<std::size_t> pick(0, blocks.size() - 1);
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        const std::size_t block = pick(dice);
        was += blocks[block];
        is += after[i].blocks[block];
      }
    }
    // The floor's standard deviation includes that of the noise, which before and after share.
    const double level = floor.mean + floor.std * normal(dice);
    const double gap = was / floor.measurements - level;
    if (gap > 0) closures.push_back(1 - (is / floor.measurements - level) / gap);
  }
  std::ranges::sort(closures);
  return closures;
}

}  // namespace

Comparison compare(const Prepared& mission, const Library& library, const Eigen::VectorXd& effects) {
  const ResidualModel model = mission.model(library, 1);
  const NullBank& bank = mission.bank;
  const Layout layout = layout_of(model.replay);
  Eigen::VectorXd improved = effects;
  improved.head<Library::kBiases>() = mission.at.head<Library::kBiases>();
  Comparison result;
  Fitted before = fitted(model, mission.at, nullptr);
  Fitted after = fitted(model, improved, &result.course);
  result.measurements = static_cast<double>(Whitening::count(before.white));
  result.before = power_of(before.white, layout);
  result.after = power_of(after.white, layout);
  result.nominal = std::move(before.innovations);
  result.improved = std::move(after.innovations);
  result.fix_times_s = mission.mission.fix_times_s();
  result.channel_floor = bank.explained_rms.mean_square.col(overall_regime()).cwiseSqrt();
  double square = 0;
  for (const double power : bank.powers) result.floor += power / static_cast<double>(bank.powers.size());
  for (const double power : bank.powers) square += (power - result.floor) * (power - result.floor);
  result.floor_std = std::sqrt(square / std::max<double>(1, static_cast<double>(bank.powers.size()) - 1));
  return result;
}

HeldOutPrediction predict_held_out(const ResidualModel& model, const Eigen::VectorXd& without,
                                   const Eigen::VectorXd& with) {
  const Eigen::VectorXd poorer = fitted(model, without, nullptr).white;
  const Eigen::VectorXd better = fitted(model, with, nullptr).white;
  return {0.5 * (poorer.squaredNorm() - better.squaredNorm()), power_of(better, layout_of(model.replay))};
}

PooledClosure pooled_closure(const std::vector<Comparison>& comparisons) {
  std::vector<Power> after;
  after.reserve(comparisons.size());
  for (const Comparison& each : comparisons) after.push_back(each.after);
  return pooled_closure(comparisons, after);
}

PooledClosure pooled_closure(const std::vector<Comparison>& comparisons, const std::vector<Power>& after) {
  PooledClosure pooled;
  double measurements = 0, floor_variance = 0;
  for (const Comparison& each : comparisons) measurements += each.measurements;
  if (!(measurements > 0)) return pooled;
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Comparison& each = comparisons[i];
    const double weight = each.measurements / measurements;
    pooled.before += weight * each.before.mean_square;
    pooled.after += weight * after[i].mean_square;
    pooled.floor += weight * each.floor;
    floor_variance += weight * weight * each.floor_std * each.floor_std;
  }
  const double floor_std = std::sqrt(floor_variance);
  pooled.clear = pooled.before - pooled.floor > kHoldoutGap_sigma * floor_std;
  if (!pooled.clear) return pooled;
  pooled.closed = 1 - (pooled.after - pooled.floor) / (pooled.before - pooled.floor);
  const std::vector<double> closures =
      resampled_closures(comparisons, after, {pooled.floor, floor_std, measurements});
  if (closures.size() < kResamples / 2) {
    pooled.clear = false;
    return pooled;
  }
  const auto quantile = [&](double q) {
    return closures[static_cast<std::size_t>(q * static_cast<double>(closures.size() - 1))];
  };
  pooled.lower = std::min(quantile(0.025), pooled.closed);
  pooled.upper = std::max(quantile(0.975), pooled.closed);
  return pooled;
}

}  // namespace navcal::gap
