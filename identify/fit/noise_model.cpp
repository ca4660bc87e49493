// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/noise_model.h"

#include <algorithm>
#include <cmath>

namespace navcal::identify {
namespace {

constexpr double kFewest = 100;       ///< readings of a channel whose noise is estimated
constexpr double kLeastScale = 0.2;   ///< stated noise is not that much too large
constexpr double kCorrelated = 0.98;  ///< greatest correlation, so that the filter stays stable
constexpr double kSignificant = 3;    ///< correlations below so many standard errors are chance

}  // namespace

void NoiseModel::whiten(const std::vector<WindowReading>& readings, Eigen::Ref<Eigen::MatrixXd> rows) const {
  // Backwards, so that the rows before are still as they were.
  for (Eigen::Index i = rows.rows() - 1; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    const OfChannel& noise = of(readings[at].channel);
    const auto is_same = [&](Eigen::Index back) {
      return i >= back && readings[static_cast<std::size_t>(i - back)].channel == readings[at].channel;
    };
    const auto std_of = [&](Eigen::Index back) { return readings[static_cast<std::size_t>(i - back)].std; };
    const double r1 = noise.rho_1, r2 = noise.rho_2;
    double variance = 1;
    rows.row(i) /= std_of(0);
    if (is_same(2)) {
      const double below = 1 - r1 * r1;
      const double a1 = r1 * (1 - r2) / below, a2 = (r2 - r1 * r1) / below;
      rows.row(i) -= a1 / std_of(1) * rows.row(i - 1) + a2 / std_of(2) * rows.row(i - 2);
      variance = 1 - a1 * r1 - a2 * r2;
    } else if (is_same(1)) {
      rows.row(i) -= r1 / std_of(1) * rows.row(i - 1);
      variance = 1 - r1 * r1;
    }
    rows.row(i) /= noise.scale * std::sqrt(variance);
  }
}

NoiseModel NoiseModel::fitted_to(std::span<const WindowResiduals> windows, double fitted) {
  std::array<double, kChannels> n{}, square{}, pairs_1{}, square_1{}, pairs_2{}, square_2{};
  for (const WindowResiduals& window : windows) {
    const auto& readings = *window.readings;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const auto c = static_cast<std::size_t>(readings[i].channel);
      const auto unit = [&](std::size_t back) {
        return (*window.values)[static_cast<Eigen::Index>(i - back)] / readings[i - back].std;
      };
      const double x = unit(0);
      n[c] += 1;
      square[c] += x * x;
      if (i >= 1 && readings[i - 1].channel == readings[i].channel) {
        pairs_1[c] += x * unit(1);
        square_1[c] += 1;
      }
      if (i >= 2 && readings[i - 2].channel == readings[i].channel) {
        pairs_2[c] += x * unit(2);
        square_2[c] += 1;
      }
    }
  }
  double all = 0;
  for (const double count : n) all += count;
  NoiseModel model;
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (n[c] == 0) continue;
    OfChannel& noise = model.channels_[c];
    // Each channel takes its share of the unknowns.
    const double free = std::max(n[c] * (1 - fitted / all), 0.5 * n[c]);
    const double scale = std::sqrt(square[c] / free);
    if (n[c] < kFewest) {
      noise.scale = std::max(scale, 1.0);
      continue;
    }
    noise.scale = std::max(scale, kLeastScale);
    const double chance = kSignificant / std::sqrt(n[c]);
    const double mean_square = square[c] / n[c];
    const double r1 = pairs_1[c] / std::max(square_1[c], 1.0) / mean_square;
    const double r2 = pairs_2[c] / std::max(square_2[c], 1.0) / mean_square;
    if (std::abs(r1) < chance && std::abs(r2) < chance) continue;
    noise.rho_1 = std::clamp(r1, -kCorrelated, kCorrelated);
    // Within what a stationary process can have.
    const double least = 2 * noise.rho_1 * noise.rho_1 - 1;
    noise.rho_2 = std::clamp(r2, least + 0.02 * (1 - least), kCorrelated);
  }
  return model;
}

}  // namespace navcal::identify
