// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/pooled_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/statistics.h"
#include "fleet/causes/limits.h"

namespace navcal::fleet {

PooledEvidence::PooledEvidence(const PooledMissions& missions, const std::vector<ActingCause>& acting)
    : missions_(missions) {
  for (const MissionGroup& design : missions.designs()) {
    add(column(0, missions.size(), design.missions, kDesignTolerance));
  }
  for (const MissionGroup& day : missions.days()) {
    for (const EffectColumns& effect : missions.effects()) {
      if (effect.is_of_surroundings) add(column(effect.first, effect.count, day.missions, kDayTolerance));
    }
  }
  first_acting_ = columns_.size();
  for (const ActingCause& each : acting) {
    const EffectColumns& effect = missions.effects()[each.cause.effect];
    add(column(effect.first, effect.count, each.cause.missions, each.strength));
  }
  // Scaled by the prior, so that the factor is well conditioned.
  Eigen::MatrixXd scaled = Eigen::MatrixXd::Identity(size_, size_);
  Eigen::VectorXd half(size_), prior(size_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& a = columns_[i];
    prior.segment(a.at, a.count).setConstant(a.prior);
    half.segment(a.at, a.count) = a.prior * score(a);
    for (std::size_t j = 0; j <= i; ++j) {
      const Column& b = columns_[j];
      const Eigen::MatrixXd part = a.prior * b.prior * gram(a, b);
      scaled.block(a.at, b.at, a.count, b.count) += part;
      if (i != j) scaled.block(b.at, a.at, b.count, a.count) += part.transpose();
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  mean_ = prior.cwiseProduct(factor.solve(half));
  covariance_ = prior.asDiagonal() * factor.solve(Eigen::MatrixXd::Identity(size_, size_)) * prior.asDiagonal();
}

void PooledEvidence::add(Column column) {
  column.at = size_;
  size_ += column.count;
  columns_.push_back(std::move(column));
}

PooledEvidence::Column PooledEvidence::column(Eigen::Index first, Eigen::Index count,
                                              std::vector<std::size_t> missions, double prior) const {
  Column made{first, count, std::move(missions), {}, prior, 0};
  for (const std::size_t m : made.missions) {
    const std::size_t vehicle = missions_.vehicle_of(m);
    auto found = std::ranges::find_if(made.white, [&](const auto& each) { return each.first == vehicle; });
    if (found == made.white.end()) {
      found = made.white.insert(found, {vehicle, Eigen::MatrixXd::Zero(missions_.size(), count)});
    }
    found->second += missions_.information(m).middleCols(first, count);
  }
  for (auto& [vehicle, white] : made.white) {
    missions_.tolerance_factor(vehicle).matrixL().solveInPlace(white);
  }
  return made;
}

Eigen::MatrixXd PooledEvidence::gram(const Column& a, const Column& b) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(a.count, b.count);
  auto other = b.missions.begin();
  for (const std::size_t m : a.missions) {
    other = std::lower_bound(other, b.missions.end(), m);
    if (other == b.missions.end()) break;
    if (*other == m) sum += missions_.information(m).block(a.first, b.first, a.count, b.count);
  }
  for (const auto& [vehicle, white] : a.white) {
    for (const auto& [of, others] : b.white) {
      if (of == vehicle) sum.noalias() -= white.transpose() * others;
    }
  }
  return sum;
}

Eigen::VectorXd PooledEvidence::score(const Column& a) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(a.count);
  for (const std::size_t m : a.missions) sum += missions_.score(m).segment(a.first, a.count);
  for (const auto& [vehicle, white] : a.white) sum.noalias() -= white.transpose() * missions_.white_score(vehicle);
  return sum;
}

PooledEvidence::Gain PooledEvidence::gain(const PossibleCause& cause) const {
  const EffectColumns& effect = missions_.effects()[cause.effect];
  const Column z = column(effect.first, effect.count, cause.missions, 1);
  // What the model without the cause leaves of its regressors. Columns without a vehicle in common are apart.
  std::vector<std::pair<Eigen::Index, Eigen::MatrixXd>> cross;
  Eigen::Index rows = 0;
  for (const Column& other : columns_) {
    const bool meet = std::any_of(other.white.begin(), other.white.end(), [&](const auto& each) {
      return std::any_of(z.white.begin(), z.white.end(), [&](const auto& own) { return own.first == each.first; });
    });
    if (!meet) continue;
    cross.emplace_back(other.at, gram(other, z));
    rows += other.count;
  }
  Eigen::MatrixXd joint(rows, z.count), covariance(rows, rows);
  Eigen::VectorXd mean(rows);
  for (Eigen::Index row = 0; const auto& [at, block] : cross) {
    joint.middleRows(row, block.rows()) = block;
    mean.segment(row, block.rows()) = mean_.segment(at, block.rows());
    for (Eigen::Index to = 0; const auto& [at_other, other] : cross) {
      covariance.block(row, to, block.rows(), other.rows()) =
          covariance_.block(at, at_other, block.rows(), other.rows());
      to += other.rows();
    }
    row += block.rows();
  }
  const Eigen::VectorXd left = score(z) - joint.transpose() * mean;
  Eigen::MatrixXd information = gram(z, z) - joint.transpose() * covariance * joint;
  information = (0.5 * (information + information.transpose())).eval();

  Gain best;
  double greatest = -std::numeric_limits<double>::infinity();
  std::array<double, kCauseStrengths.size()> nats{};
  for (std::size_t i = 0; i < nats.size(); ++i) {
    const double slab = kCauseStrengths[i];
    Eigen::MatrixXd scaled = slab * slab * information;
    scaled.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
    const Eigen::VectorXd solved = slab * slab * factor.solve(left);
    nats[i] = 0.5 * left.dot(solved) - factor.matrixLLT().diagonal().array().log().sum();
    if (nats[i] <= greatest) continue;
    greatest = nats[i];
    best.strength = slab;
    best.mean = solved;
    best.covariance = slab * slab * factor.solve(Eigen::MatrixXd::Identity(z.count, z.count));
  }
  best.log_odds = base::log_mean_exp(nats) + cause.log_prior;
  for (Eigen::Index j = 0; j < z.count; ++j) {
    const gap::ParameterName& name =
        missions_.missions().front().information.parameters[static_cast<std::size_t>(z.first + j)];
    best.is_within_bounds = best.is_within_bounds && best.mean[j] > name.least && best.mean[j] < name.greatest;
  }
  return best;
}

Eigen::VectorXd PooledEvidence::mean_of(std::size_t i) const {
  const Column& column = columns_[first_acting_ + i];
  return mean_.segment(column.at, column.count);
}

Eigen::VectorXd PooledEvidence::std_of(std::size_t i) const {
  const Column& column = columns_[first_acting_ + i];
  return covariance_.diagonal().segment(column.at, column.count).cwiseSqrt();
}

}  // namespace navcal::fleet
