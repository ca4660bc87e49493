// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "gap/thresholds.h"

// Thresholds of the diagnosis of layouts, with their units and the arguments for them.
namespace navcal::diagnosis {

// The same as for the reference vehicle.
using gap::kComplexityPenalty_nats;
using gap::kComplexityPenaltyPerFurtherEffect_nats;
using gap::kHoldoutGain_nats;
using gap::kHoldoutLoss_nats;
using gap::kLargestStrength;
using gap::kMemberStrengths;
using gap::kMostEffects;

/// Step of a finite difference, as part of the typical strength: small against it, large against rounding. What
/// cannot be negative is not linear about zero (a dead actuator, a lag, a dead band where there is none): its
/// difference takes a typical strength.
inline constexpr double kEffectStep = 0.01, kOneSidedStep = 1;
/// Passes over the nominal recordings: each is linearised again at the estimate by all of them. The noises are
/// fitted in the first ones.
inline constexpr std::size_t kNominalRounds = 3, kNoiseRounds = 2;
/// Nominal recordings that the noises are fitted to; more change them little and take as long again.
inline constexpr std::size_t kNoiseFrom = 4;
/// The first of identify::kIntervals_s that is tried. What a layout leaves out of a vehicle (how a rotor spins up,
/// how the water follows) goes on for some tenths of a second: readings closer than that say it several times.
inline constexpr std::size_t kFirstInterval = 1;
/// Standard deviation of what is usual in vehicles and between recordings, typical strengths, and the number of
/// observations that it counts as.
inline constexpr double kUsualTolerance = 0.1, kToleranceWeight = 2;
/// And the largest: what departs by a typical strength is an effect.
inline constexpr double kMostTolerance = 1;
/// Part of the variance between recordings that those which are judged together have in common. They may be of one
/// session, whose departures do not average out, or of several.
inline constexpr double kSessionShare = 0.5;
/// Steps of expectation and maximisation for the tolerances, in each pass over the nominal recordings.
inline constexpr int kToleranceSteps = 8;
/// A dead or reversed actuator is so in full: standard deviation of its share.
inline constexpr double kSwitchScatter = 0.05;
/// Leading single causes that are fitted again at their own estimate, and sets that are because they lead without.
inline constexpr std::size_t kRefitted = 4, kReconsidered = 4;
/// Mean square of the innovations up to which a recording is thought to be linear over the way to its explanation:
/// nominal ones have up to 1.3.
inline constexpr double kLinearPower = 2;
/// Mean square above which the nominal vehicle's filter is led astray: its errors are ten times what it expects,
/// so it is linear about states that never were.
/// The filter of a dead or reversed actuator's vehicle serves instead where it leaves so many times less.
inline constexpr double kAstrayPower = 100, kFarBetter = 10;
/// A set with which the vehicle could not have moved as it did is so far behind.
inline constexpr double kImpossible_nats = 1e6;
/// A recording has settled where its evidence changes by less, and is given up after so many passes.
inline constexpr double kSettledWithin_nats = 1;
inline constexpr int kMostSettlings = 8;
/// A step is damped so much more where it led to less, up to a factor.
inline constexpr double kDampingStep = 8, kMostDamping = 1000;
/// A figure of a recording (a channel's noise power) exceeds that of nominal recordings with this probability by
/// chance, by the scatter of theirs (Student's t; of one of them only, by so many of its presumed standard
/// deviations), and by tolerances that they do not show up to this factor; the power of all channels together,
/// which has many more readings, up to the smaller one.
inline constexpr double kNominalChance = 0.02, kNominalScatter_sigma = 5, kNominalFactor = 2,
                        kNominalPowerFactor = 1.12;
/// The power of a channel in a nominal recording counts as if so many more readings had the power 1 that fitted
/// noises lead to: the only reading of a channel may happen to be right.
inline constexpr double kFewReadings = 20;
/// An innovation counts at most so much in the power of its channel: single wild readings are no louder channel.
inline constexpr double kWild_sigma = 3;
/// Length of the blocks of time that a closure's interval is drawn from, s: longer than the filter's memory of
/// most vehicles.
inline constexpr double kBlock_s = 5;

/// A cause is named where all sets without it, and without those that cannot be told from it, are so many nats
/// behind, beyond what nominal recordings have for it by chance.
inline constexpr double kNamed_nats = 15;
/// And by this share of the lead of the best set over no cause: where one cause has thousands of nats, what the
/// layout gets wrong about it has tens. Only one nat of each reading counts: more is no longer told from noise.
inline constexpr double kNamedShare = 0.02;
/// Causes are not told apart where one in place of the other costs less.
inline constexpr double kClass_nats = 5;
/// A recording has a gap where the best set leads no set by so many nats, beyond the chance of nominal recordings.
/// A smaller lead, of odds of 20 to 1, is said: simulated nominal recordings of 30 s have up to 13 nats.
/// Beside one nominal recording twice as many: it tells nothing of the scatter between recordings.
inline constexpr double kGap_nats = 10, kFaint_nats = 3;
/// The same three of mean forces over steady stretches (SteadyRecording). The scatter between nominal recordings
/// is in the evidence, with the tails of Student's t, so a set that is more probable than no effect is a gap; a
/// cause is told from another with a probability of 0.8.
inline constexpr double kSteadyGap_nats = 0, kSteadyNamed_nats = 0, kSteadyClass_nats = 1.4;
/// Recordings that count for the independence of a scatter's axes.
inline constexpr double kAxesWeight = 4;
/// A cause is named only if one of its parameters is so many standard errors from zero.
inline constexpr double kLeastPresence_sigma = 2;

}  // namespace navcal::diagnosis
