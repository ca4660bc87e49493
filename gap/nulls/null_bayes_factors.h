// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "gap/inference/model_fit.h"
#include "gap/nulls/null_bank.h"

namespace navcal::gap {

/// By how much a set is better than none, nats, by these straight lines.
[[nodiscard]] double gain_over_none(const EffectSubset& set, const LinearGaussianModel& model);

/// By how much a set of effects is better than none, nats, on simulated missions that have no gap and were steered
/// as the recorded one: one each. The signatures of the members, and of what looks most like them, are taken of
/// each of these missions. A replay is led by its instruments, so that their noise is in the signatures as it is
/// in the innovations; where hardly anything else moves, on a straight course, that makes evidence of which the
/// bank, all of it compared with the recorded mission's signatures, knows nothing. `problem` is that of the
/// recorded mission.
[[nodiscard]] std::vector<double> null_bayes_factors(const EffectSubset& set, const RepeatedMission& repeated,
                                                     const InferenceProblem& problem, const BankOptions& options);

/// Whether a gain is more than these scatter about.
[[nodiscard]] bool stands_out(double gain_nats, std::span<const double> among_nulls);

}  // namespace navcal::gap
