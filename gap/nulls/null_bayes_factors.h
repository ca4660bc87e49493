// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/inference/model_fit.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// Log evidence of a subset minus that of no effect, nats, in one linear model.
[[nodiscard]] double gain_over_none(const EffectSubset& set, const LinearGaussianModel& model);

/// Null Bayes factors: log evidence of a subset minus that of no effect, nats, on simulated missions that have
/// no gap and were steered as the recorded one, or as each of several recorded ones. One value for each null
/// vehicle. `problem` is that of the recorded missions, and `repeated` has them in the same order.
///
/// The regressors of the members, and of the unknowns most like them, are computed for each of these missions.
/// The instruments correct the replay, so their noise is in the regressors as well as in the innovations. Where
/// little else moves, on a straight course, that correlation raises the evidence. The null bank does not
/// contain this rise, because it compares all its missions with the recorded mission's regressors.
[[nodiscard]] std::vector<double> null_bayes_factors(const EffectSubset& set,
                                                     std::span<const RepeatedMission> repeated,
                                                     const InferenceProblem& problem, const BankOptions& options);

/// Whether a gain is significantly larger than the null Bayes factors.
[[nodiscard]] bool stands_out(double gain_nats, std::span<const double> among_nulls);

}  // namespace navcal::gap
