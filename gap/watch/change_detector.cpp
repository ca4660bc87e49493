// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/change_detector.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/statistics.h"

namespace navcal::gap {
namespace {

constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();
/// Onsets are kept so that two are apart by at most this share of their age.
constexpr double kThinning = 0.5;
/// Factor on the scatter of a channel's power among windows. Powers are not exactly gamma-distributed, and a wider
/// distribution is the careful choice.
constexpr double kScatterFactor = 2;
/// Share of nominal windows below the power that stands for all of them. Set.
constexpr double kQuantile = 0.95;

/// Factor of 1 + root^T gram root.
Eigen::LLT<Eigen::MatrixXd> factor_of(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& root) {
  Eigen::MatrixXd scaled = root.transpose() * gram * root;
  scaled.diagonal().array() += 1;
  return Eigen::LLT<Eigen::MatrixXd>(scaled);
}

}  // namespace

double WatchedCause::strength(const Eigen::VectorXd& change) const {
  const Eigen::VectorXd parts = change.cwiseQuotient(typical);
  return is_vector ? parts.norm() : parts.lpNorm<Eigen::Infinity>();
}

ChangeDetector::ChangeDetector(std::vector<WatchedCause> candidates, Eigen::MatrixXd root, double noise_factor,
                               double model_error)
    : candidates_(std::move(candidates)), root_(std::move(root)), noise_factor_(noise_factor),
      model_error_(model_error), gram_(Eigen::MatrixXd::Zero(root_.rows(), root_.rows())),
      score_(Eigen::VectorXd::Zero(root_.rows())), log_statistic_(kMinusInfinity),
      mean_(Eigen::VectorXd::Zero(root_.rows())) {}

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
  const Eigen::LLT<Eigen::MatrixXd> factor = factor_of(gram_, root_);
  mean_ = root_ * factor.solve(root_.transpose() * score_);
  scored_.clear();
  log_statistic_ = kMinusInfinity;
  const double log_candidates = std::log(static_cast<double>(candidates_.size()));
  for (const State::Onset& onset : onsets_) {
    const Eigen::MatrixXd since = gram_ - onset.gram;
    const Eigen::VectorXd score = score_ - onset.score - since * mean_;
    // Information about a change, less what the unknowns of all windows can take up.
    const Eigen::MatrixXd through = factor.matrixL().solve(root_.transpose() * since);
    const Eigen::MatrixXd left = since - through.transpose() * through;
    const double allowed = model_error_ * std::sqrt(0.5 * (measurements_ - onset.measurements));
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const auto& [name, columns, typical, is_vector, most] = candidates_[i];
      const Eigen::MatrixXd information = left(columns, columns);
      const Eigen::VectorXd own = score(columns);
      Scored scored{i, onset.window, kMinusInfinity, Eigen::VectorXd::Zero(std::ssize(columns))};
      double best = kMinusInfinity;
      for (const double strength : kMemberStrengths) {
        const Eigen::VectorXd slab = strength * typical;
        Eigen::MatrixXd scaled = slab.asDiagonal() * information * slab.asDiagonal();
        scaled.diagonal().array() += 1;
        const Eigen::LLT<Eigen::MatrixXd> own_factor(scaled);
        const Eigen::VectorXd half = slab.cwiseProduct(own);
        const Eigen::VectorXd solved = own_factor.solve(half);
        // Half the square of what the cause explains, less the error that the model may have.
        const double explained = std::max(0.0, std::sqrt(0.5 * half.dot(solved)) - allowed);
        const double log_factor = explained * explained - own_factor.matrixLLT().diagonal().array().log().sum();
        scored.log_factor = base::log_sum_exp(scored.log_factor, log_factor);
        if (log_factor > best) {
          best = log_factor;
          scored.change = slab.cwiseProduct(solved);
        }
      }
      scored.log_factor -= std::log(static_cast<double>(kMemberStrengths.size()));
      // Where the mission hardly shows an effect, only an impossible amount of it explains an error of the model.
      if (candidates_[i].strength(scored.change) > most) scored.log_factor = kMinusInfinity;
      log_statistic_ = base::log_sum_exp(log_statistic_, scored.log_factor - log_candidates);
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
    Sum& sum = sums[scored.candidate];
    sum.log_all = base::log_sum_exp(sum.log_all, scored.log_factor);
    log_total = base::log_sum_exp(log_total, scored.log_factor);
    if (scored.log_factor > sum.log_best) {
      sum.log_best = scored.log_factor;
      sum.onset = scored.onset;
    }
  }
  std::vector<Cause> causes;
  for (const auto& [candidate, sum] : sums) {
    causes.push_back({candidate, log_total > kMinusInfinity ? std::exp(sum.log_all - log_total) : 0, sum.onset});
  }
  std::ranges::stable_sort(causes, std::ranges::greater(), &Cause::probability);
  return causes;
}

Eigen::VectorXd ChangeDetector::mean_with(const Cause& cause) const {
  Eigen::VectorXd mean = mean_;
  for (const Scored& scored : scored_) {
    if (scored.candidate == cause.candidate && scored.onset == cause.onset)
      mean(candidates_[cause.candidate].columns) += scored.change;
  }
  return mean;
}

Eigen::VectorXd ChangeDetector::mean_with_all() const {
  const std::uint64_t onset = causes().front().onset;
  const auto since = std::ranges::find_if(onsets_, [&](const State::Onset& one) { return one.window == onset; });
  Eigen::MatrixXd covariance = root_ * root_.transpose();
  for (const WatchedCause& candidate : candidates_) {
    for (std::size_t i = 0; i < candidate.columns.size(); ++i) {
      const Eigen::Index column = candidate.columns[i];
      const double typical = candidate.typical[static_cast<Eigen::Index>(i)];
      covariance(column, column) = std::max(covariance(column, column), typical * typical);
    }
  }
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  return root * factor_of(gram_ - since->gram, root).solve(root.transpose() * (score_ - since->score));
}

double ChangeDetector::strength(const Cause& cause) const {
  const WatchedCause& candidate = candidates_[cause.candidate];
  return candidate.strength(mean_with(cause)(candidate.columns));
}

void ChangeDetector::restore(State state) {
  const auto n = root_.rows();
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

NominalPower nominal_power(std::span<const Eigen::VectorXd> windows, Eigen::Index tested, std::size_t fewest,
                           double least_scatter) {
  if (windows.empty()) return {};
  const Eigen::Index channels = windows.front().size();
  Eigen::VectorXd high = Eigen::VectorXd::Ones(channels), scatter = Eigen::VectorXd::Zero(channels);
  double sum = 0, count = 0;
  for (Eigen::Index c = 0; c < tested; ++c) {
    std::vector<double> powers;
    for (const Eigen::VectorXd& window : windows) {
      if (std::isfinite(window[c])) powers.push_back(window[c]);
    }
    if (powers.size() < fewest) continue;
    std::sort(powers.begin(), powers.end());
    const auto n = static_cast<double>(powers.size());
    const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) / n;
    double square = 0;
    for (const double power : powers) square += (power - mean) * (power - mean);
    high[c] = std::max(mean, powers[static_cast<std::size_t>(kQuantile * n)]);
    scatter[c] = std::max(std::sqrt(square / n), least_scatter * mean);
    sum += mean;
    count += 1;
  }
  return {PowerDetector(high, scatter), count > 0 ? std::max(1.0, sum / count) : 1};
}

}  // namespace navcal::gap
