// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/blocks.h"

#include <algorithm>

#include "gap/inference/evidence.h"
#include "gap/inference/model_fit.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Gain in log likelihood by the effects on the rows that are not learned from, nats: log p(judged | learned),
/// with the effects minus without. It is the difference of two log evidences, so an estimate counts with its
/// error: rows that cannot tell the effects predict little, and lose little.
double gain_beyond(const Eigen::VectorXd& learn, const EffectSubset& effects, const LinearGaussianModel& model) {
  const Linearised& linear = model.linear;
  const Priors& priors = model.priors;
  const Eigen::VectorXd data = residual_at_zero(linear);
  const Priors others = without_members(priors, model.library, effects);
  Eigen::VectorXd wide = priors.spike;
  for (const Eigen::Index j : parameter_indices(model.library, effects)) wide[j] = priors.slab[j];
  const auto log_likelihood = [&](const Eigen::VectorXd& rows, const Eigen::VectorXd& prior) {
    const Eigen::MatrixXd design = rows.asDiagonal() * linear.design;
    return Evidence(design.transpose() * linear.design, design.transpose() * data, prior, prior).base();
  };
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(learn.size());
  return log_likelihood(all, wide) - log_likelihood(learn, wide) - log_likelihood(all, others.spike) +
         log_likelihood(learn, others.spike);
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
  std::vector<double> gains;
  for (const bool learn_from_even : {true, false}) {
    gains.push_back(
        gain_beyond(learn_from_even ? mask : Eigen::VectorXd((1 - mask.array()).matrix()), effects, model));
  }
  return gains;
}

std::vector<double> gains_of_recordings(const EffectSubset& effects, const LinearGaussianModel& model,
                                        std::span<const Eigen::Index> rows) {
  std::vector<double> gains;
  Eigen::Index from = 0;
  for (const Eigen::Index count : rows) {
    Eigen::VectorXd learn = Eigen::VectorXd::Ones(model.linear.residual.size());
    learn.segment(from, count).setZero();
    gains.push_back(gain_beyond(learn, effects, model));
    from += count;
  }
  return gains;
}

}  // namespace navcal::gap
