// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/subset_evidence.h"

#include <cmath>
#include <vector>

#include "base/statistics.h"
#include "gap/thresholds.h"

namespace navcal::gap {
Evidence evidence_of(const Linearised& linear, const Priors& priors) {
  return {linear.gram, linear.score + linear.gram * linear.at, priors.spike, priors.slab};
}

SubsetEvidence::SubsetEvidence(const LinearGaussianModel& model)
    : library_(model.library), evidence_(evidence_of(model.linear, model.priors)),
      data_(-0.5 * residual_at_zero(model.linear).squaredNorm()) {}

double SubsetEvidence::operator()(const EffectSubset& set) const {
  if (set.empty()) return data_ + evidence_.base();
  const auto count = static_cast<double>(set.size());
  const double against = count * std::log(static_cast<double>(library_.size())) + kComplexityPenalty_nats +
                         (count - 1) * kComplexityPenaltyPerFurtherEffect_nats;
  return data_ + evidence_.base() + gain(set) - against;
}

/// Gain in log marginal likelihood, averaged over all combinations of the members' strengths.
double SubsetEvidence::gain(const EffectSubset& set) const {
  const auto members = parameter_indices(library_, set);
  Eigen::VectorXd slabs(static_cast<Eigen::Index>(members.size()));
  std::size_t combinations = 1;
  for (std::size_t i = 0; i < set.size(); ++i) combinations *= kMemberStrengths.size();
  std::vector<double> gains(combinations);
  for (std::size_t n = 0; n < combinations; ++n) {
    Eigen::Index at = 0;
    std::size_t rest = n;
    for (const std::size_t effect : set) {
      for (Eigen::Index k = 0; k < library_.count(effect); ++k) {
        slabs[at] = kMemberStrengths[rest % kMemberStrengths.size()] *
                    library_.unknowns()[static_cast<std::size_t>(library_.first(effect) + k)].typical;
        ++at;
      }
      rest /= kMemberStrengths.size();
    }
    gains[n] = evidence_.gain(members, slabs);
  }
  return base::log_mean_exp(gains);
}

}  // namespace navcal::gap
