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
/// A channel's noise power exceeds that of nominal recordings by chance up to so many standard deviations of
/// theirs, and by tolerances that they do not show up to this factor.
inline constexpr double kChannelScatter_sigma = 5, kChannelFactor = 1.5;

}  // namespace navcal::diagnosis
