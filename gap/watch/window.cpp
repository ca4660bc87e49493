// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "gap/actuators/commanded_motor.h"
#include "gap/inference/order_times.h"
#include "gap/replay/regimes.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr std::string_view kWaterCurrent = "water_current";
/// Effects that build up over minutes. The biases of each window take up a drift of a gyro.
constexpr std::array<std::string_view, 4> kSlow{"gyro_drift", "gyro_random_walk", "stalls", "magnetic_hysteresis"};

}  // namespace

std::vector<Eigen::Index> window_nuisances(const Library& library) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index j = 0; j < Library::kBiases; ++j) columns.push_back(j);
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    if (library[effect].name != kWaterCurrent) continue;
    for (Eigen::Index k = 0; k < library.count(effect); ++k) columns.push_back(library.first(effect) + k);
  }
  return columns;
}

EffectSubset watched_effects(const Library& library) {
  EffectSubset watched;
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    const std::string_view name = library[effect].name;
    if (!library.holds(effect) || name == kWaterCurrent ||
        std::find(kSlow.begin(), kSlow.end(), name) != kSlow.end())
      continue;
    watched.push_back(effect);
  }
  return watched;
}

Window::Window(const WindowProblem& problem, Mission mission, const GyroBias& bias_rad_s)
    : problem_(problem), mission_(std::move(mission)) {
  obey_orders(mission_, problem.vehicle);
  if (mission_.order_times_s.empty()) {
    mission_.order_times_s = likely_order_times_s(mission_, problem.vehicle, problem.library, 1);
  }
  replay_ = std::make_unique<Replay>(mission_, problem.vehicle);
  at_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.library.unknowns().size()));
  for (Eigen::Index i = 0; i < Library::kBiases; ++i) at_[i] = bias_rad_s[static_cast<std::size_t>(i)];
}

bool Window::can_be_judged() const {
  return replay_->intervals() >= kLeastIntervals + std::llround(kSettling_s / kInterval_s);
}

ResidualModel Window::model() const { return {*replay_, problem_.library, problem_.whitening, 1}; }

/// Sets the rows before the judged part to zero.
void Window::forget_settling(Eigen::MatrixXd& rows) const {
  const Eigen::Index intervals = replay_->intervals();
  const Eigen::Index skipped = std::max<Eigen::Index>(0, intervals - std::llround(kWindow_s / kInterval_s));
  rows.topRows(skipped * kEvidenceChannels).setZero();
  const double judged_from_s = mission_.duration_s - kWindow_s;
  for (std::size_t i = 0; i < mission_.fixes.size() && mission_.fixes[i].time_s < judged_from_s; ++i) {
    const Eigen::Index row = intervals * kEvidenceChannels + static_cast<Eigen::Index>(i) * kFixChannels;
    rows.middleRows(row, kFixChannels).setZero();
  }
}

Eigen::VectorXd Window::power_of(const Eigen::VectorXd& left) const {
  const Eigen::Index grid = replay_->intervals() * kEvidenceChannels;
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(kPowerChannels), counts = sums;
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    if (measured_[i] == 0) continue;
    const Eigen::Index channel = i < grid ? i % kEvidenceChannels : kEvidenceChannels + (i - grid) % kFixChannels;
    sums[channel] += left[i] * left[i];
    counts[channel] += 1;
  }
  constexpr double kFewest = 5;
  Eigen::VectorXd power = sums.cwiseQuotient(counts);
  for (Eigen::Index c = 0; c < kPowerChannels; ++c) {
    if (counts[c] < kFewest) power[c] = std::numeric_limits<double>::quiet_NaN();
  }
  return power;
}

ReplayedEvidence Window::evidence() {
  const Library& library = problem_.library;
  Eigen::MatrixXd residual = residual_at(model(), at_);
  const Eigen::MatrixXd some = design_at(model(), at_, residual, problem_.columns);
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(residual.size(), at_.size());
  for (std::size_t i = 0; i < problem_.columns.size(); ++i) {
    design.col(problem_.columns[i]) = some.col(static_cast<Eigen::Index>(i));
  }
  forget_settling(residual);
  forget_settling(design);
  measured_ = residual;

  // What least squares of the nuisances, with their priors, leave of all else (Frisch and Waugh 1933).
  const auto nuisances = window_nuisances(library);
  const auto k = static_cast<Eigen::Index>(nuisances.size());
  basis_.resize(design.rows(), k);
  Eigen::VectorXd prior(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::Index j = nuisances[static_cast<std::size_t>(i)];
    prior[i] = (j < Library::kBiases ? 1 : kNuisancePrior) * problem_.priors.slab[j];
    basis_.col(i) = prior[i] * design.col(j);
  }
  Eigen::MatrixXd normal = basis_.transpose() * basis_;
  normal.diagonal().array() += 1;
  factor_.compute(normal);
  ReplayedEvidence window;
  const Eigen::VectorXd fitted = factor_.solve(basis_.transpose() * residual);
  const Eigen::VectorXd left = residual - basis_ * fitted;
  const Eigen::MatrixXd cross = basis_.transpose() * design;
  window.gram = design.transpose() * design - cross.transpose() * factor_.solve(cross);
  window.score = design.transpose() * left;
  for (const Eigen::Index j : nuisances) {
    window.gram.row(j).setZero();
    window.gram.col(j).setZero();
    window.score[j] = 0;
  }
  for (Eigen::Index i = 0; i < Library::kBiases; ++i) {
    at_[i] += prior[i] * fitted[i];
    window.bias_rad_s[static_cast<std::size_t>(i)] = at_[i];
  }
  window.measurements = static_cast<double>(Whitening::count(measured_));
  window.power = power_of(left);
  Trajectory10Hz course;
  const Innovations innovations = replay_->run(library.model(at_), &course);
  window.explained_rms = explained_rms(innovations, course, mission_.fix_times_s());
  return window;
}

Eigen::VectorXd Window::power_with(Eigen::VectorXd values) const {
  values.head<Library::kBiases>() = at_.head<Library::kBiases>();
  Eigen::MatrixXd residual = residual_at(model(), values);
  forget_settling(residual);
  return power_of(residual - basis_ * factor_.solve(basis_.transpose() * residual));
}

}  // namespace navcal::gap
