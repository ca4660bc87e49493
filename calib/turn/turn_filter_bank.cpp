// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/turn_filter_bank.h"

#include <algorithm>
#include <cmath>

namespace navcal::calib {
namespace {

/// Shares of the largest walk, and how probable each is before the first reading.
constexpr std::array kWalkShares{0.0, 0.1, 1.0};
constexpr std::array kPrior{0.8, 0.15, 0.05};
/// Largest log-weight by which a filter may fall behind the best.
constexpr double kFurthestBehind_nats = 8;

TurnFilter filter_with(TurnFilter::Parameters parameters, double share, const TurnPrior& prior) {
  parameters.bias_walk_rad_s_sqrt_s *= share;
  return TurnFilter(parameters, prior);
}

}  // namespace

TurnFilterBank::TurnFilterBank(const TurnFilter::Parameters& parameters, const TurnPrior& prior)
    : filters_{filter_with(parameters, kWalkShares[0], prior), filter_with(parameters, kWalkShares[1], prior),
               filter_with(parameters, kWalkShares[2], prior)} {
  std::transform(kPrior.begin(), kPrior.end(), log_weights_.begin(), [](double p) { return std::log(p); });
}

void TurnFilterBank::update(const TurnStep& step) {
  std::array<double, kFilters> before{};
  for (std::size_t i = 0; i < kFilters; ++i) before[i] = filters_[i].log_likelihood();
  for (TurnFilter& filter : filters_) filter.update(step);
  // Where the noise is larger than stated, differences mean less.
  const double noise = std::max(best().reduced_chi_squared(), 1.0);
  for (std::size_t i = 0; i < kFilters; ++i) {
    log_weights_[i] += (filters_[i].log_likelihood() - before[i]) / noise;
  }
  const double most = *std::max_element(log_weights_.begin(), log_weights_.end());
  for (double& weight : log_weights_) weight = std::max(weight - most, -kFurthestBehind_nats);
}

std::array<double, TurnFilterBank::kFilters> TurnFilterBank::weights() const {
  std::array<double, kFilters> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < kFilters; ++i) sum += weights[i] = std::exp(log_weights_[i]);
  for (double& weight : weights) weight /= sum;
  return weights;
}

const TurnFilter& TurnFilterBank::best() const {
  const auto most = std::max_element(log_weights_.begin(), log_weights_.end());
  return filters_[static_cast<std::size_t>(most - log_weights_.begin())];
}

TurnCoefficients TurnFilterBank::estimate() const {
  const auto weight = weights();
  TurnCoefficients mean = TurnCoefficients::Zero();
  for (std::size_t i = 0; i < kFilters; ++i) mean += weight[i] * filters_[i].estimate();
  return mean;
}

TurnCovariance TurnFilterBank::covariance() const {
  const auto weight = weights();
  const TurnCoefficients mean = estimate();
  TurnCovariance covariance = TurnCovariance::Zero();
  for (std::size_t i = 0; i < kFilters; ++i) {
    const TurnCoefficients apart = filters_[i].estimate() - mean;
    covariance += weight[i] * (filters_[i].covariance() + apart * apart.transpose());
  }
  return covariance;
}

void TurnFilterBank::archive(Archive& archive) {
  archive.tag("turn_filter_bank 1");
  archive(filters_, log_weights_);
}

}  // namespace navcal::calib
