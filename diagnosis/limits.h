// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/thresholds.h"

// Thresholds of the diagnosis of layouts, with their units and the arguments for them.
namespace navcal::diagnosis {

// The same as for the reference vehicle.
using gap::kComplexityPenalty_nats;
using gap::kComplexityPenaltyPerFurtherEffect_nats;
using gap::kHoldoutGain_nats;
using gap::kLargestStrength;
using gap::kMemberStrengths;
using gap::kMostEffects;
using gap::kMostRivals;
using gap::kNamedFrom;
using gap::kNoGapBelow;
using gap::kObservable_nats;
using gap::kTolerance;

/// Step of a finite difference, as part of the typical strength: small against it, large against rounding.
inline constexpr double kEffectStep = 0.01;
/// Leading sets of each size that are fitted again at their own estimate.
inline constexpr std::size_t kRefitted = 3;
/// A figure of a recording (a channel's noise power, the misfit) exceeds that of nominal recordings by chance up
/// to so many standard deviations of theirs, and by tolerances that they do not show up to this factor.
inline constexpr double kNominalScatter_sigma = 5, kNominalFactor = 1.5;

/// A cause is named only if one of its parameters is so many standard errors from zero.
inline constexpr double kLeastPresence_sigma = 2;
/// A fit has not settled if the estimate by its linearisation lies further from the fitted value than so many
/// typical strengths and so many standard errors.
inline constexpr double kSettledWithin = 1, kSettledWithin_sigma = 5;

}  // namespace navcal::diagnosis
