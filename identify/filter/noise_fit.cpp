// SPDX-License-Identifier: Apache-2.0
#include "identify/filter/noise_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace navcal::identify {
namespace {

constexpr int kNoiseSteps = 40;
constexpr double kNoiseSettled = 1, kLogStep = 0.01, kLongestLog = 2;  ///< of a logarithm
constexpr double kLonger = 1.5, kShorter = 0.5;                        ///< a step than the one before
constexpr double kDisturbanceStd = 2, kFactorStd = 1;                  ///< of the priors, of logarithms
constexpr double kLeastShare = 0.01;                                   ///< of the actuators' accelerations
constexpr double kWorthLonger = 4;                                     ///< twice a log likelihood

/// The logarithms of the sizes that are fitted. A channel that always reads the same (zero, of what was not
/// measured) tells nothing of its noise.
class Sizes {
 public:
  explicit Sizes(std::span<const FollowedRecording> recordings) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      const auto varies = [&](const FollowedRecording& one) { return one.filter->recording().varies(c); };
      if (std::any_of(recordings.begin(), recordings.end(), varies)) channels_.push_back(c);
    }
  }
  [[nodiscard]] Eigen::VectorXd of(FilterNoises noises) const {
    const auto places = places_in(noises);
    Eigen::VectorXd logs(std::ssize(places));
    for (std::size_t i = 0; i < places.size(); ++i) logs[static_cast<Eigen::Index>(i)] = std::log(*places[i]);
    return logs;
  }
  [[nodiscard]] FilterNoises with(FilterNoises noises, const Eigen::VectorXd& logs) const {
    const auto places = places_in(noises);
    for (std::size_t i = 0; i < places.size(); ++i) *places[i] = std::exp(logs[static_cast<Eigen::Index>(i)]);
    return noises;
  }
  /// No layout is perfect, and a filter that takes it to be is linear nowhere: disturbances are not below a share
  /// of what the actuators do.
  [[nodiscard]] Eigen::VectorXd least(std::span<const FollowedRecording> recordings) const {
    sim::Vector6 power = sim::Vector6::Zero();
    for (const auto& [filter, pass] : recordings)
      power += filter->actuator_power(*pass) / static_cast<double>(recordings.size());
    const FilterNoises usual;
    FilterNoises none;
    none.factor.fill(std::numeric_limits<double>::min());
    none.coloured = (kLeastShare * power.cwiseSqrt()).cwiseMax(std::numeric_limits<double>::min());
    none.white = none.coloured.cwiseProduct(usual.white.cwiseQuotient(usual.coloured));
    return of(none);
  }
  [[nodiscard]] Eigen::VectorXd prior_stds() const {
    Eigen::VectorXd stds = Eigen::VectorXd::Constant(kDisturbances + std::ssize(channels_), kFactorStd);
    stds.head<kDisturbances>().setConstant(kDisturbanceStd);
    return stds;
  }

 private:
  static constexpr Eigen::Index kDisturbances = 12;

  [[nodiscard]] std::vector<double*> places_in(FilterNoises& noises) const {
    std::vector<double*> places;
    for (double& one : noises.white) places.push_back(&one);
    for (double& one : noises.coloured) places.push_back(&one);
    for (const std::size_t channel : channels_) places.push_back(&noises.factor[channel]);
    return places;
  }

  std::vector<std::size_t> channels_;
};

/// Logarithms of the variances of all recordings and the innovations, one number for each reading.
struct Filtered {
  Eigen::ArrayXd log_variance, innovation;

  [[nodiscard]] double cost() const { return (log_variance + innovation.square() * (-log_variance).exp()).sum(); }
};

Filtered filtered(std::span<const FollowedRecording> recordings, const FilterNoises& noises) {
  Eigen::Index count = 0;
  for (const auto& one : recordings) count += std::ssize(one.pass->readings);
  Filtered all{Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  Eigen::Index at = 0;
  std::vector<FilterPass::Reading> readings;
  for (const auto& one : recordings) {
    readings.resize(one.pass->readings.size());
    one.filter->filter_again(*one.pass, noises, readings);
    for (const auto& reading : readings) {
      all.log_variance[at] = std::log(reading.variance);
      all.innovation[at++] = reading.white * std::sqrt(reading.variance);
    }
  }
  return all;
}

NoiseFit fit(const Sizes& sizes, const Eigen::VectorXd& least, std::span<const FollowedRecording> recordings,
             const FilterNoises& start, unsigned threads) {
  const Eigen::VectorXd usual = sizes.of(FilterNoises{});
  const Eigen::VectorXd precision = sizes.prior_stds().cwiseAbs2().cwiseInverse();
  const auto cost_of = [&](const Filtered& of, const Eigen::VectorXd& logs) {
    return of.cost() + precision.dot((logs - usual).cwiseAbs2());
  };
  Eigen::VectorXd logs = sizes.of(start).cwiseMax(least);
  Filtered here = filtered(recordings, sizes.with(start, logs));
  double cost = cost_of(here, logs);
  // Sizes that hardly matter go too far and come back; with one length for all, the others would wait for them.
  Eigen::VectorXd last = Eigen::VectorXd::Zero(logs.size());
  Eigen::ArrayXd longest = Eigen::ArrayXd::Constant(logs.size(), kLongestLog);
  for (int step = 0; step < kNoiseSteps; ++step) {
    const Eigen::Index n = logs.size(), rows = here.innovation.size();
    Eigen::MatrixXd of_variance(rows, n), of_innovation(rows, n);
    const Eigen::ArrayXd deviation = (0.5 * here.log_variance).exp();
    base::in_parallel(threads, static_cast<std::size_t>(n), [&](std::size_t i) {
      const auto at = static_cast<Eigen::Index>(i);
      const Filtered moved =
          filtered(recordings, sizes.with(start, logs + kLogStep * Eigen::VectorXd::Unit(n, at)));
      of_variance.col(at) = (moved.log_variance - here.log_variance) / kLogStep;
      of_innovation.col(at) = (moved.innovation - here.innovation) / (kLogStep * deviation);
    });
    const Eigen::ArrayXd white = here.innovation / deviation;
    const Eigen::VectorXd gradient = of_variance.transpose() * ((1 - white.square()) / 2).matrix() +
                                     of_innovation.transpose() * white.matrix() +
                                     precision.cwiseProduct(logs - usual);
    Eigen::MatrixXd information =
        of_variance.transpose() * of_variance / 2 + of_innovation.transpose() * of_innovation;
    information.diagonal() += precision;
    const Eigen::VectorXd wanted = -information.ldlt().solve(gradient);
    longest = (wanted.array() * last.array() < 0).select(kShorter * longest, (kLonger * longest).min(kLongestLog));
    Eigen::VectorXd change = wanted.array().max(-longest).min(longest);
    last = change;
    double gain = -1;
    for (int halving = 0; halving < 6 && gain < 0; ++halving, change /= 2) {
      const Eigen::VectorXd next = (logs + change).cwiseMax(least);
      Filtered there = filtered(recordings, sizes.with(start, next));
      const double after = cost_of(there, next);
      if (!(after < cost)) continue;
      gain = cost - after;
      cost = after;
      logs = next;
      here = std::move(there);
    }
    if (gain < kNoiseSettled) break;
  }
  return {sizes.with(start, logs), cost};
}

}  // namespace

NoiseFit fit_noises(std::span<const FollowedRecording> recordings, const FilterNoises& start, unsigned threads) {
  const Sizes sizes(recordings);
  return fit(sizes, sizes.least(recordings), recordings, start, threads);
}

NoiseFit fit_noises_and_tau(std::span<const FollowedRecording> recordings, const FilterNoises& start,
                            unsigned threads) {
  const Sizes sizes(recordings);
  const Eigen::VectorXd least = sizes.least(recordings);
  NoiseFit best{start, std::numeric_limits<double>::infinity()};
  for (const double tau_s : {1.0, 3.0, 10.0, 30.0}) {
    FilterNoises from = best.cost < std::numeric_limits<double>::infinity() ? best.noises : start;
    from.tau_s = tau_s;
    const NoiseFit found = fit(sizes, least, recordings, from, threads);
    if (found.cost < best.cost - kWorthLonger || tau_s == 1) best = found;
  }
  return best;
}

double least_correlation(std::span<const FollowedRecording> recordings, const FilterNoises& noises) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [filter, pass] : recordings) {
    std::vector<FilterPass::Reading> again(pass->readings.size());
    filter->filter_again(*pass, noises, again);
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (!filter->recording().varies(c)) continue;
      const auto neighbours = filter->neighbours(again, c);
      sum += neighbours.count * neighbours.correlation();
      count += neighbours.count;
    }
    if (count > 0) least = std::min(least, sum / count);
  }
  return least;
}

std::string thinned_warning(double interval_s) {
  return fmt::format(
      "neighbouring readings are not independent (filtered or interpolated?): one in {:g} s of each channel is "
      "used",
      interval_s);
}

}  // namespace navcal::identify
