// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/change_detector.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "base/statistics.h"
#include "gap/inference/evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();
/// Onsets are kept so that two are apart by at most this share of their age.
constexpr double kThinning = 0.5;
/// Factor on the scatter of a channel's power among windows. Powers are not exactly gamma-distributed, and a wider
/// distribution is the careful choice.
constexpr double kScatterFactor = 2;

}  // namespace

ChangeDetector::ChangeDetector(const Library& library, const Priors& priors, EffectSubset effects,
                               double noise_factor)
    : library_(library), spike_(priors.spike), effects_(std::move(effects)), noise_factor_(noise_factor),
      gram_(Eigen::MatrixXd::Zero(spike_.size(), spike_.size())), score_(Eigen::VectorXd::Zero(spike_.size())),
      log_statistic_(kMinusInfinity), mean_(Eigen::VectorXd::Zero(spike_.size())) {}

void ChangeDetector::take(const Eigen::MatrixXd& gram, const Eigen::VectorXd& score, double measurements) {
  onsets_.push_back({windows_, gram_, score_, measurements_});
  gram_ += gram / noise_factor_;
  score_ += score / noise_factor_;
  measurements_ += measurements;
  ++windows_;
  thin_out();
  score_onsets();
}

void ChangeDetector::thin_out() {
  for (std::size_t i = 1; i + 1 < onsets_.size();) {
    const auto span = static_cast<double>(onsets_[i + 1].window - onsets_[i - 1].window);
    const auto age = static_cast<double>(windows_ - onsets_[i].window);
    if (span <= kThinning * age) {
      onsets_.erase(onsets_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

void ChangeDetector::score_onsets() {
  // Unknowns in units of their spikes: G' = D G D, so that the prior precision is 1.
  Eigen::MatrixXd total = spike_.asDiagonal() * gram_ * spike_.asDiagonal();
  total.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(total);
  const Eigen::VectorXd mean = factor.solve(spike_.cwiseProduct(score_));
  mean_ = spike_.cwiseProduct(mean);
  scored_.clear();
  log_statistic_ = kMinusInfinity;
  const double log_effects = std::log(static_cast<double>(effects_.size()));
  for (const State::Onset& onset : onsets_) {
    const Eigen::MatrixXd since = spike_.asDiagonal() * (gram_ - onset.gram) * spike_.asDiagonal();
    const Eigen::VectorXd score = spike_.cwiseProduct(score_ - onset.score) - since * mean;
    // Information about a change, less what the unknowns of all windows can take up.
    const Eigen::MatrixXd left = since - since * factor.solve(since);
    const double allowed = kModelError * std::sqrt(0.5 * (measurements_ - onset.measurements));
    for (const std::size_t effect : effects_) {
      const Eigen::Index first = library_.first(effect), count = library_.count(effect);
      const Eigen::MatrixXd information = left.block(first, first, count, count);
      const Eigen::VectorXd own = score.segment(first, count);
      Scored scored{effect, onset.window, kMinusInfinity, Eigen::VectorXd::Zero(count)};
      double best = kMinusInfinity;
      for (const double strength : kMemberStrengths) {
        Eigen::VectorXd slab(count);
        for (Eigen::Index i = 0; i < count; ++i) {
          slab[i] =
              strength * library_.unknowns()[static_cast<std::size_t>(first + i)].typical / spike_[first + i];
        }
        Eigen::MatrixXd scaled = slab.asDiagonal() * information * slab.asDiagonal();
        scaled.diagonal().array() += 1;
        const Eigen::LLT<Eigen::MatrixXd> own_factor(scaled);
        const Eigen::VectorXd half = slab.cwiseProduct(own);
        const Eigen::VectorXd solved = own_factor.solve(half);
        // Half the square of what the effect explains, less the error that the model may have.
        const double explained = std::max(0.0, std::sqrt(0.5 * half.dot(solved)) - allowed);
        const double log_factor = explained * explained - own_factor.matrixLLT().diagonal().array().log().sum();
        scored.log_factor = base::log_sum_exp(scored.log_factor, log_factor);
        if (log_factor > best) {
          best = log_factor;
          scored.change = spike_.segment(first, count).cwiseProduct(slab.cwiseProduct(solved));
        }
      }
      scored.log_factor -= std::log(static_cast<double>(kMemberStrengths.size()));
      // Where the mission hardly shows an effect, only an impossible amount of it explains an error of the model.
      Eigen::VectorXd values = Eigen::VectorXd::Zero(spike_.size());
      values.segment(first, count) = scored.change;
      if (strength_of(library_, effect, values) > kLargestStrength) scored.log_factor = kMinusInfinity;
      log_statistic_ = base::log_sum_exp(log_statistic_, scored.log_factor - log_effects);
      scored_.push_back(std::move(scored));
    }
  }
}

std::vector<ChangeDetector::Cause> ChangeDetector::causes() const {
  struct Sum {
    double log_all = kMinusInfinity, log_best = kMinusInfinity;
    std::uint64_t onset = 0;
  };
  std::map<std::size_t, Sum> sums;
  double log_total = kMinusInfinity;
  for (const Scored& scored : scored_) {
    Sum& sum = sums[scored.effect];
    sum.log_all = base::log_sum_exp(sum.log_all, scored.log_factor);
    log_total = base::log_sum_exp(log_total, scored.log_factor);
    if (scored.log_factor > sum.log_best) {
      sum.log_best = scored.log_factor;
      sum.onset = scored.onset;
    }
  }
  std::vector<Cause> causes;
  for (const auto& [effect, sum] : sums) {
    causes.push_back({effect, log_total > kMinusInfinity ? std::exp(sum.log_all - log_total) : 0, sum.onset});
  }
  std::ranges::stable_sort(causes, std::ranges::greater(), &Cause::probability);
  return causes;
}

Eigen::VectorXd ChangeDetector::mean_with(const Cause& cause) const {
  Eigen::VectorXd mean = mean_;
  for (const Scored& scored : scored_) {
    if (scored.effect == cause.effect && scored.onset == cause.onset) {
      mean.segment(library_.first(cause.effect), library_.count(cause.effect)) += scored.change;
    }
  }
  return mean;
}

Eigen::VectorXd ChangeDetector::mean_with_all() const {
  const std::uint64_t onset = causes().front().onset;
  const auto since = std::ranges::find_if(onsets_, [&](const State::Onset& one) { return one.window == onset; });
  Eigen::VectorXd prior = spike_;
  for (const Eigen::Index j : parameter_indices(library_, effects_)) {
    prior[j] = library_.unknowns()[static_cast<std::size_t>(j)].typical;
  }
  return posterior_mean(gram_ - since->gram, score_ - since->score, prior);
}

double ChangeDetector::strength(const Cause& cause) const {
  return strength_of(library_, cause.effect, mean_with(cause));
}

void ChangeDetector::restore(State state) {
  const auto n = spike_.size();
  const auto is_shaped = [&](const Eigen::MatrixXd& gram, const Eigen::VectorXd& score) {
    return gram.rows() == n && gram.cols() == n && score.size() == n && gram.allFinite() && score.allFinite();
  };
  bool fits = is_shaped(state.gram, state.score);
  for (const State::Onset& onset : state.onsets) {
    fits = fits && is_shaped(onset.gram, onset.score) && onset.window < state.windows;
  }
  if (!fits) throw std::invalid_argument("the state is of another library");
  windows_ = state.windows;
  measurements_ = state.measurements;
  gram_ = std::move(state.gram);
  score_ = std::move(state.score);
  onsets_ = std::move(state.onsets);
  score_onsets();
}

PowerDetector::PowerDetector(Eigen::VectorXd mean, const Eigen::VectorXd& scatter)
    : mean_(std::move(mean)), shape_(mean_.size()),
      log_channels_(Eigen::VectorXd::Constant(mean_.size(), kNothing)) {
  for (Eigen::Index c = 0; c < mean_.size(); ++c) {
    const double ratio = mean_[c] / (kScatterFactor * scatter[c]);
    shape_[c] = std::isfinite(ratio) ? ratio * ratio : 0;
  }
}

void PowerDetector::take(const Eigen::VectorXd& power) {
  for (Eigen::Index c = 0; c < mean_.size(); ++c) {
    if (!std::isfinite(power[c]) || !(shape_[c] > 0)) continue;
    const double log_ratio = shape_[c] * (power[c] / mean_[c] * (1 - 1 / kRise) - std::log(kRise));
    // R = (1 + R) times the likelihood ratio.
    log_channels_[c] = std::max(kNothing, base::log_sum_exp(0, log_channels_[c]) + log_ratio);
  }
}

double PowerDetector::log_statistic() const {
  double log_all = kMinusInfinity;
  for (const double one : log_channels_) log_all = base::log_sum_exp(log_all, one);
  return log_all - std::log(static_cast<double>(std::max<Eigen::Index>(1, log_channels_.size())));
}

Eigen::Index PowerDetector::loudest() const {
  Eigen::Index channel = 0;
  log_channels_.maxCoeff(&channel);
  return channel;
}

void PowerDetector::restore(const Eigen::VectorXd& log_channels) {
  if (log_channels.size() != log_channels_.size() || !log_channels.allFinite())
    throw std::invalid_argument("the state is of other channels");
  log_channels_ = log_channels;
}

}  // namespace navcal::gap
