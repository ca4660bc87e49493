// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/blocks.h"

#include <array>

#include "gap/inference/evidence.h"
#include "gap/inference/model_fit.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Gain in log likelihood by the effects on the rows that are not learned from, nats, for each of `learned` (1 in
/// rows to learn from): log p(judged | learned), with the effects minus without. It is the difference of two log
/// evidences, so an estimate counts with its error: rows that cannot tell the effects predict little, and lose
/// little.
std::vector<double> gains_beyond(std::span<const Eigen::VectorXd> learned, const EffectSubset& effects,
                                 const LinearGaussianModel& model) {
  const Eigen::MatrixXd& design = model.linear.design;
  const Eigen::VectorXd data = residual_at_zero(model.linear);
  const Eigen::VectorXd without = without_members(model.priors, model.library, effects).spike;
  Eigen::VectorXd with = model.priors.spike;
  for (const Eigen::Index j : parameter_indices(model.library, effects)) with[j] = model.priors.slab[j];
  const auto gain_of = [&](const Eigen::VectorXd& rows) {
    const Eigen::MatrixXd weighted = rows.asDiagonal() * design;
    const Eigen::MatrixXd gram = weighted.transpose() * design;
    const Eigen::VectorXd score = weighted.transpose() * data;
    return Evidence(gram, score, with, with).base() - Evidence(gram, score, without, without).base();
  };
  const double of_all = gain_of(Eigen::VectorXd::Ones(data.size()));
  std::vector<double> gains;
  for (const Eigen::VectorXd& rows : learned) gains.push_back(of_all - gain_of(rows));
  return gains;
}

}  // namespace

bool is_in_even_minute(Eigen::Index row, const Layout& layout, Eigen::Index rows) {
  const Eigen::Index grid = layout.intervals * kEvidenceChannels;
  if (row < grid) {
    const Eigen::Index interval = row / kEvidenceChannels;
    return static_cast<long>(static_cast<double>(interval) * kInterval_s / kPieceOfMission_s) % 2 == 0;
  }
  return row < (grid + rows) / 2;
}

std::vector<double> gains_of_blocks(const EffectSubset& effects, const LinearGaussianModel& model,
                                    const Layout& layout) {
  const Eigen::Index rows = model.linear.residual.size();
  Eigen::VectorXd mask(rows);
  for (Eigen::Index i = 0; i < rows; ++i) mask[i] = is_in_even_minute(i, layout, rows) ? 1 : 0;
  const std::array<Eigen::VectorXd, 2> learned{mask, 1 - mask.array()};
  return gains_beyond(learned, effects, model);
}

std::vector<double> gains_of_recordings(const EffectSubset& effects, const LinearGaussianModel& model,
                                        std::span<const Eigen::Index> rows) {
  std::vector<Eigen::VectorXd> learned;
  Eigen::Index from = 0;
  for (const Eigen::Index count : rows) {
    learned.emplace_back(Eigen::VectorXd::Ones(model.linear.residual.size())).segment(from, count).setZero();
    from += count;
  }
  return gains_beyond(learned, effects, model);
}

}  // namespace navcal::gap
