// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/blocks.h"

#include <algorithm>

#include "gap/inference/evidence.h"
#include "gap/inference/model_fit.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Whether the evidence tells each of the effects, at these values, from every other one.
bool tells(const Evidence& evidence, const EffectSubset& effects, const Eigen::VectorXd& values,
           const Library& library) {
  for (const std::size_t effect : effects) {
    const auto members = parameter_indices(library, {effect});
    for (std::size_t other = 0; other < library.size(); ++other) {
      if (std::find(effects.begin(), effects.end(), other) != effects.end() || !library.holds(other)) continue;
      if (evidence.separation(members, values, parameter_indices(library, {other})) < kObservable_nats)
        return false;
    }
  }
  return true;
}

/// Gain in log likelihood by the effects on the rows that are not learnt from, nats. `learn` is 1 in rows to learn
/// from. Rows that cannot tell the effects from another one predict nothing: a loss by them is none.
double gain_beyond(const Eigen::VectorXd& learn, const EffectSubset& effects, const LinearGaussianModel& model) {
  const Linearised& linear = model.linear;
  const Priors& priors = model.priors;
  const Eigen::VectorXd data = residual_at_zero(linear);
  const auto members = parameter_indices(model.library, effects);
  const Priors others = without_members(priors, model.library, effects);
  const Eigen::MatrixXd design = learn.asDiagonal() * linear.design;
  const Eigen::MatrixXd gram = design.transpose() * linear.design;
  const Eigen::VectorXd score = design.transpose() * data;
  const Eigen::VectorXd without = Evidence(gram, score, others.spike, others.slab).base_posterior().mean;
  const Evidence evidence(gram, score, priors.spike, priors.slab);
  const Eigen::VectorXd with = evidence.posterior(members).mean;
  const Eigen::VectorXd judged = (1 - learn.array()).matrix();
  const auto misfit = [&](const Eigen::VectorXd& values) {
    return judged.cwiseProduct(data - linear.design * values).squaredNorm();
  };
  const double gain_nats = 0.5 * (misfit(without) - misfit(with));
  return gain_nats < 0 && !tells(evidence, effects, with, model.library) ? 0 : gain_nats;
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
