// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identify/filter/noise_fit.h"
#include "identify/fit/estimate.h"

namespace navcal::identify {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kStepSettled = 0.05;  ///< of the cost: far below a standard error
constexpr double kBlock_s = 5;
/// Commands of an autopilot may be followed a second later: by the way to the actuators, and by their lags.
constexpr double kDelayOfCommands_s = 0.7, kEarliest_s = -0.05;
constexpr Eigen::Index kDelayAt = static_cast<Eigen::Index>(Nuisance::actuator_delay);

}  // namespace

Eigen::VectorXd step_within(const Eigen::MatrixXd& information, const Eigen::VectorXd& score,
                            const Eigen::VectorXd& at, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(at.size());
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < at.size(); ++i) free.push_back(i);
  while (!free.empty()) {
    // What is held moves the others; scaled to a diagonal of one, as units differ by many orders.
    const Eigen::VectorXd right = (score - information * step)(free) + (information(free, free) * step(free));
    const Eigen::MatrixXd block = information(free, free);
    const Eigen::VectorXd scale = block.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * block * scale.asDiagonal();
    step(free) = scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(right)));
    const auto beyond = [&](Eigen::Index i) { return at[i] + step[i] < low[i] || at[i] + step[i] > high[i]; };
    const auto first = std::stable_partition(free.begin(), free.end(), [&](auto i) { return !beyond(i); });
    if (first == free.end()) break;
    for (auto i = first; i != free.end(); ++i)
      step[*i] = std::clamp(at[*i] + step[*i], low[*i], high[*i]) - at[*i];
    free.erase(first, free.end());
  }
  return step;
}

Calibration estimated_nuisance_stds(const FilteredReplay& filter) {
  Calibration stds = nuisance_stds(filter.recording());
  if (filter.follows_commands()) stds[kDelayAt] = kDelayOfCommands_s;
  return stds;
}

PredictionErrorProblem::PredictionErrorProblem(const config::Layout& layout,
                                               const std::vector<Parameter>& parameters,
                                               const std::vector<RecordedMotion>& recordings,
                                               const EstimateSettings& settings)
    : settings_(settings) {
  for (const RecordedMotion& recording : recordings)
    filters_.emplace_back(layout, parameters, recording, FilterNoises{}, settings.threads);
  const Eigen::Index n = nuisances_at(recordings.size());
  precision_.resize(n);
  low_ = Eigen::VectorXd::Constant(n, -kUnbounded);
  high_ = -low_;
  const Eigen::Index count = nuisances_at(0);
  precision_.head(count) = prior_stds(parameters).cwiseAbs2().cwiseInverse();
  low_.head(count) = lower_bounds(parameters);
  high_.head(count) = upper_bounds(parameters);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    precision_.segment<kNuisances>(nuisances_at(r)) =
        estimated_nuisance_stds(filters_[r]).cwiseAbs2().cwiseInverse();
    if (filters_[r].follows_commands()) low_[nuisances_at(r) + kDelayAt] = kEarliest_s;
  }
}

Eigen::VectorXd PredictionErrorProblem::start() const {
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(precision_.size());
  unknowns.head(std::ssize(parameters())) = prior_values(parameters());
  return unknowns.cwiseMax(low_).cwiseMin(high_);
}

Eigen::VectorXd PredictionErrorProblem::values_of(const Eigen::VectorXd& unknowns, std::size_t recording) const {
  Eigen::VectorXd values(std::ssize(parameters()) + kNuisances);
  values << unknowns.head(std::ssize(parameters())), unknowns.segment<kNuisances>(nuisances_at(recording));
  return values;
}

Eigen::VectorXd PredictionErrorProblem::deviation(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd away = unknowns;
  away.head(std::ssize(parameters())) -= prior_values(parameters());
  return away;
}

PredictionErrorProblem::Point PredictionErrorProblem::at(Eigen::VectorXd unknowns) const {
  Point point{std::move(unknowns), {}};
  point.cost = precision_.dot(deviation(point.unknowns).cwiseAbs2());
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    auto pass = filters_[r].follow(values_of(point.unknowns, r));
    point.cost += pass ? pass->cost() : kUnbounded;
    if (!std::isfinite(point.cost)) return Point{std::move(point.unknowns), {}, kUnbounded};
    point.passes.push_back(std::move(*pass));
  }
  return point;
}

PredictionErrorProblem::Linearised PredictionErrorProblem::linearise(const Point& point, Parameters which) const {
  const auto parameters = which == Parameters::free ? std::ssize(this->parameters()) : 0;
  const Eigen::Index n = precision_.size();
  Linearised all{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n), {}, {}, {}};
  std::vector<Eigen::VectorXd> blocks;
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    std::vector<Eigen::Index> columns, places;
    for (Eigen::Index i = 0; i < parameters; ++i) {
      columns.push_back(i);
      places.push_back(i);
    }
    for (Eigen::Index i = 0; i < kNuisances; ++i) {
      if (!filters_[r].matters(static_cast<Nuisance>(i))) continue;
      columns.push_back(std::ssize(this->parameters()) + i);
      places.push_back(nuisances_at(r) + i);
    }
    const FilterLinearised linear = filters_[r].linearise(point.passes[r], columns);
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(n, n);
    own(places, places) = linear.information();
    all.information += own;
    all.information_of.push_back(std::move(own));
    all.first_of_blocks.push_back(std::ssize(blocks));
    const auto& readings = filters_[r].readings();
    for (std::size_t first = 0; first < readings.size();) {
      std::size_t end = first;
      const double until_s = readings[first].time_s + kBlock_s;
      while (end < readings.size() && readings[end].time_s < until_s) ++end;
      const auto rows = static_cast<Eigen::Index>(end - first), from = static_cast<Eigen::Index>(first);
      Eigen::VectorXd score = Eigen::VectorXd::Zero(n);
      score(places) = -linear.jacobian.middleRows(from, rows).transpose() * linear.white.segment(from, rows);
      all.score += score;
      blocks.push_back(std::move(score));
      first = end;
    }
  }
  all.first_of_blocks.push_back(std::ssize(blocks));
  all.block_scores.resize(n, std::ssize(blocks));
  for (std::size_t b = 0; b < blocks.size(); ++b) all.block_scores.col(static_cast<Eigen::Index>(b)) = blocks[b];
  return all;
}

PredictionErrorProblem::Point PredictionErrorProblem::minimise(Point from, int most, Parameters which,
                                                               const FitProgress& progress,
                                                               std::string_view what) const {
  from.is_settled = from.passes.empty();
  const int first = from.steps;
  while (from.steps < first + most && !from.is_settled) {
    progress(what, static_cast<double>(from.steps - first) / most);
    ++from.steps;
    Linearised linear = linearise(from, which);
    linear.information.diagonal() += precision_;
    Eigen::VectorXd score = linear.score - precision_.cwiseProduct(deviation(from.unknowns));
    if (which == Parameters::fixed) score.head(std::ssize(parameters())).setZero();
    Eigen::VectorXd step = step_within(linear.information, score, from.unknowns, low_, high_);
    from.is_settled = true;
    constexpr int kHalvings = 7;
    for (int k = 0; k < kHalvings; ++k, step /= 2) {
      Point next = at(from.unknowns + step);
      if (!(next.cost < from.cost)) continue;
      next.steps = from.steps;
      next.is_settled = from.cost - next.cost < kStepSettled;
      from = std::move(next);
      break;
    }
  }
  return from;
}

Eigen::VectorXd PredictionErrorProblem::with_delays(Eigen::VectorXd unknowns) const {
  for (std::size_t r = 0; r < filters_.size(); ++r) {
    if (!filters_[r].follows_commands()) continue;
    Eigen::VectorXd values = values_of(unknowns, r);
    double& delay_s = values[std::ssize(parameters()) + kDelayAt];
    double least = kUnbounded, best_s = delay_s;
    for (const double tried_s : {0.0, 0.1, 0.2, 0.4, 0.7, 1.1, 1.6, 2.2, 3.0}) {
      delay_s = tried_s;
      const auto pass = filters_[r].follow(values);
      const double cost =
          pass ? pass->cost() + precision_[nuisances_at(r) + kDelayAt] * tried_s * tried_s : kUnbounded;
      if (cost >= least) continue;
      least = cost;
      best_s = tried_s;
    }
    unknowns[nuisances_at(r) + kDelayAt] = best_s;
  }
  return unknowns;
}

std::size_t PredictionErrorProblem::leave_out_diverging(const Eigen::VectorXd& unknowns) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < filters_.size(); ++r)
    count += filters_[r].leave_out_diverging(values_of(unknowns, r));
  return count;
}

std::vector<FollowedRecording> PredictionErrorProblem::followed(const Point& point) const {
  std::vector<FollowedRecording> all;
  for (std::size_t r = 0; r < filters_.size(); ++r) all.push_back({&filters_[r], &point.passes[r]});
  return all;
}

void PredictionErrorProblem::fit_noises(const Point& point, bool with_tau) {
  set_noises((with_tau ? fit_noises_and_tau(followed(point), noises(), settings_.threads)
                       : identify::fit_noises(followed(point), noises(), settings_.threads))
                 .noises);
}

void PredictionErrorProblem::set_noises(const FilterNoises& noises) {
  for (FilteredReplay& filter : filters_) filter.set_noises(noises);
}

std::vector<std::string> PredictionErrorProblem::oddities() const {
  std::vector<std::string> words;
  for (const FilteredReplay& filter : filters_)
    for (const std::string& word : filter.oddities()) words.push_back(filter.recording().name + ": " + word);
  return words;
}

}  // namespace navcal::identify
