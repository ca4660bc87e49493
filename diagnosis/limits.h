// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

// Every threshold of the diagnosis of layouts, with its unit and the argument for it. Those that it shares with
// the diagnosis of the reference vehicle have the same values (gap/thresholds.h).
namespace navcal::diagnosis {

/// Departure that every vehicle may have, as part of an effect's typical strength (docs/gap.md).
inline constexpr double kTolerance = 0.02;
/// Strengths of an effect that is present, in equal parts.
inline constexpr std::array<double, 3> kStrengths{0.2, 0.6, 2};
/// Step of a finite difference, as part of the typical strength: small against it, large against rounding.
inline constexpr double kEffectStep = 0.01;
/// Log odds that the first effect and each further one cost beside the number of ways to choose them, nats.
inline constexpr double kFirstEffect_nats = 3, kFurtherEffect_nats = 8;
/// Effects of a set at most.
inline constexpr std::size_t kMostEffects = 3;
/// Leading sets of each size that are fitted again at their own estimate.
inline constexpr std::size_t kRefitted = 3;
/// A set is named from this probability on, while all others together have at most the second one.
inline constexpr double kNamedFrom = 0.7, kMostRivals = 0.15;
/// Without this probability of the empty set there is a gap.
inline constexpr double kNoGapBelow = 0.01;
/// A strength beyond it usually stands for another cause.
inline constexpr double kLargestStrength = 5;
/// A channel's noise power exceeds that of nominal recordings by chance up to so many standard deviations of
/// theirs, and by tolerances that they do not show up to this factor.
inline constexpr double kChannelScatter_sigma = 5, kChannelFactor = 1.5;
/// Gain on held-out recordings that supports an effect, nats.
inline constexpr double kHeldOutGain_nats = 2;
/// Two sets that differ by less expected evidence cannot be told apart, nats.
inline constexpr double kObservable_nats = 10;

}  // namespace navcal::diagnosis
