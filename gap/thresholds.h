// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "base/reference_instruments.h"

/// The thresholds of the diagnosis that decide what is searched, named and reported, with unit and reason.
/// Settings of a numerical method (steps of a difference, a filter's order, a ridge) stand with the method.
/// Strengths are in typical values of the effect (sim/effects/description.h). A threshold is "set" where it was
/// chosen on validation runs (docs/validation/gap.md) and not derived; such a threshold has no false-alarm rate of
/// its own, and only the rates measured there hold.
namespace navcal::gap {

// ---- priors

/// Standard deviation of each parameter of a vehicle without a gap, typical values. By definition: docs/gap.md.
inline constexpr double kTolerance = 0.02;
/// Turn-on bias of a gyro that counts as one typical value, rad/s: that of the reference card.
inline constexpr double kTypicalTurnOnBias_rad_s = base::reference::kTurnOnBias_rad_s;
/// Standard deviation of the prior of a turn-on bias, rad/s: ten times the typical value, so that the prior never
/// decides.
inline constexpr double kTurnOnBiasPrior_rad_s = 10 * kTypicalTurnOnBias_rad_s;
/// Standard deviation of the prior of a parameter that is kept at zero, typical values: as good as zero, and the
/// matrices stay invertible.
inline constexpr double kExcludedPrior = 1e-9;
/// Factor on the prior of a non-member that is to be zero: a parameter that its bounds keep at zero, or an effect
/// that is left out on purpose.
inline constexpr double kAbsentPrior = 1e-6;
/// Smallest prior of an effect that resembles fin orders at another time, s. Order times that were not recorded
/// are estimated no finer (inference/order_times.h).
inline constexpr double kOrdersOff_s = 0.005;
/// Standard deviations of the prior of a member's strength, typical values, each as likely as the others. With one
/// wide prior for all, the many parameters of a weak effect would cost more evidence than they explain.
inline constexpr std::array<double, 3> kMemberStrengths{0.2, 0.6, 2};
/// Standard deviation of the prior of a nuisance parameter, typical values. Wider than that of any member, so that
/// naming the effect does not gain evidence.
inline constexpr double kNuisancePrior = 5;

// ---- search

/// Log evidence that the first effect of a subset costs, nats. Set: what innovations that are not quite Gaussian
/// gain by chance.
inline constexpr double kComplexityPenalty_nats = 3;
/// Log evidence that each further effect costs, nats. Set: what the inexact regressors of the effects before
/// leave.
inline constexpr double kComplexityPenaltyPerFurtherEffect_nats = 8;
/// Largest number of effects in a subset.
inline constexpr std::size_t kMostEffects = 3;
/// Subsets of each size that are simulated again.
inline constexpr std::size_t kLeadingSubsets = 3;
/// Most leading subsets that are simulated before the answer because only the regressors of another subset scored
/// them.
inline constexpr std::size_t kReconsideredSubsets = 6;
/// Times that the leader and its neighbours are judged with regressors taken about the leader's estimate. With the
/// nominal regressors, effects outside the subset look wrong, and one of them is added spuriously.
inline constexpr int kRefinements = 4;
/// Distance from the point of linearisation within which regressors serve, typical values. Within tolerances
/// the residuals are linear.
inline constexpr double kLinearRange = 0.25;
/// Linearisations about a subset's own estimate: of subsets that are nearly linear, and at most of others (lags,
/// backlash).
inline constexpr int kLinearisations = 2, kCurvedLinearisations = 5;
/// Change of an estimate, in standard errors, below which it has converged.
inline constexpr double kArrived_sigma = 0.2;
/// Loss of log evidence by which a step of a curved subset is taken back, nats.
inline constexpr double kStepBack_nats = 1;
/// Times that an estimate, tolerances included, is simulated with the same regressors.
inline constexpr int kSettlings = 4;
/// Difference between simulation and linear model below which the linear model holds, and gain below which a
/// step is refused, nats. One nat decides nothing.
inline constexpr double kSettled_nats = 1;
/// Times that a step which simulation refuses is halved.
inline constexpr int kHalvings = 2;
/// Probability from which a subset is kept among the candidates.
inline constexpr double kLeastCandidate = 1e-4;
/// Log evidence above which two effects, or an effect and none, are distinguishable, nats. Set.
inline constexpr double kObservable_nats = 10;

// ---- sources of an error

/// Most terms by which the error of one source is described.
inline constexpr std::size_t kMostErrorTerms = 5;
/// Most leading sources that are described by all covariates, where the gap is unknown, and the share of the first
/// one's gain that the next one must have.
inline constexpr std::size_t kSourcesInFull = 2;
inline constexpr double kLeastRival = 0.5;
/// Length of the piece of a mission on which sources are told apart first, s. Set: a third of the time, and most
/// gaps are clear in it.
inline constexpr double kSourcePiece_s = 200;
/// Gain of the leading source in that piece, and its lead over the next one, from which the piece decides, nats.
/// Set.
inline constexpr double kClearSource_nats = 100, kClearLead_nats = 30;

// ---- null missions

/// Null missions whose noise the whitening filter is fitted to. Set.
inline constexpr std::size_t kWhiteningMissions = 30;
/// Null missions with the backlash that was found, or for null Bayes factors: enough for a mean and a scatter, few
/// enough to wait for.
inline constexpr int kBacklashMissions = 16;
/// Least number of null missions for a recording to be judged, and most that can be asked for.
inline constexpr int kLeastNulls = 10, kMostNulls = 10'000;
/// Least resemblance of a non-member's usual tolerance to a member, in the member's standard errors, for its
/// regressor to be computed for each null mission, too; and the largest number of such non-members.
inline constexpr double kLikeness_sigma = 2;
inline constexpr std::size_t kMostLikenesses = 6;
/// Root mean square differences, over windows of ten seconds, that make one unit of distance between two missions:
/// a kept null bank serves within one unit. Set.
inline constexpr double kSameShaft_rps = 0.5, kSameTurn_rad_s = 0.05, kSameDepth_m = 0.4, kSameFixes = 4;
/// Difference of the Earth's field, uT, within which a kept null bank serves: compass.field and heading then
/// differ by a hundredth or two.
inline constexpr double kSameField_uT = 0.5;
/// Distance of two outlines below which their missions are planned to share a null bank. Set.
inline constexpr double kAlikeOutline = 0.8;

// ---- recording

/// Least number of fixes for declination, current, GPS and speed to be judged.
inline constexpr std::size_t kLeastFixes = 3;
/// Least number of 0.1 s intervals with compass, inertial card and motor card for a recording to be judged: 20
/// s.
inline constexpr int kLeastIntervals = 200;
/// Delay of the fins behind recorded commands from which it is said, s: more than latencies and clocks make.
inline constexpr double kLateCommands_s = 0.1;
/// Delay of the turns behind commands, where no report says what the fins did, from which the commands are not
/// believed, s: more than an unmodelled lag of the vehicle makes (fin_lag 0.2 s). Set.
inline constexpr double kLateUnreported_s = 0.5;
/// Share of the time with a fin at its limit from which it is said.
inline constexpr double kManySaturated = 0.05;
/// Largest misfit of recorded fin commands, in units of the report noise: a report with twice its noise has 4.
inline constexpr double kMostCommandMisfit = 4;

// ---- verdict

/// Probability from which a subset of effects is named. Set.
inline constexpr double kNamedFrom = 0.7;
/// Largest total posterior probability of rival subsets with which a subset is named. A wrong name costs a
/// needless repair; one more manoeuvre would decide. Set.
inline constexpr double kMostRivals = 0.15;
/// Probability of no effect below which a gap is stated although no cell of the residual map is significant.
/// Set.
inline constexpr double kNoGapBelow = 0.01;
/// Share of the gap that a named subset must close. Set.
inline constexpr double kClosedFrom = 0.9;
/// Closure below which the gap is reported as growing. The interval of its error reaches a little below zero
/// where nothing closes.
inline constexpr double kGrowsBelow = -0.05;
/// Strength above which an effect is more probably a substitute for another one, typical values. Set.
inline constexpr double kLargestStrength = 5;
/// Strength above which an estimate is not reported as a number, typical values.
inline constexpr double kLargestReported = 100;
/// Strength up to which an effect is a tolerance, typical values: 2.5 standard deviations of kTolerance.
inline constexpr double kLargestTolerance = 0.05;
/// Strength that tolerances three times as wide as kTolerance hardly reach, typical values.
inline constexpr double kBeyondWideTolerance = 0.2;
/// Strength above which an effect that is not named is no tolerance, however little the mission shows of it,
/// typical values.
inline constexpr double kLargestUnnamed = 0.4;
/// p-value, over all cells of the residual map together, below which a residual is unexplained. Set.
inline constexpr double kUnexplainedBelow = 1e-4;
/// p-value, over all cells together, below which a cell of the residual map is significant.
inline constexpr double kSignificantBelow = 1e-3;
/// Factor over the rms of the nulls that a significant cell must have: an instrument that is a little noisier than
/// nominal is no gap. Set.
inline constexpr double kLouderThanNulls = 1.3;
/// p-value below which a cell is significant against the exact model: a search finds the parameters only nearly.
/// Set.
inline constexpr double kSignificantAgainstExactBelow = 1e-8;
/// Standard deviations of the nulls above which the error of a hold-out is a gap.
inline constexpr double kHoldoutGap_sigma = 3;
/// Least total gain of the members over all hold-outs, and largest loss on one of them, nats. Set.
inline constexpr double kHoldoutGain_nats = 2, kHoldoutLoss_nats = -2;
/// Log evidence that no null mission has reached by its noise, nats: above it no null Bayes factors are computed.
/// Set.
inline constexpr double kBeyondNulls_nats = 300;
/// Standard deviations above their mean that evidence must exceed among null Bayes factors.
inline constexpr double kNullBayesFactor_sigma = 3;
/// Smallest scatter of null Bayes factors, nats: that of gains which hardly differ.
inline constexpr double kLeastNullScatter_nats = 1;
/// Ratio to the nulls' residuals that all channels of the motion must exceed for an unexplained recording to be
/// taken for that of another vehicle. Set: effects of the library leave some of them at their floor.
inline constexpr double kOtherVehicle = 2;
/// Length of a block of the bootstrap of closures, s: more than the 6.4 s that the whitening filter reaches back.
inline constexpr double kBlock_s = 10;
/// Resamples of that bootstrap: its 2.5 % quantile rests on 25 of them.
inline constexpr int kResamples = 1000;
/// Length of the pieces of a mission that stand in for hold-outs, s.
inline constexpr double kPieceOfMission_s = 60;

// ---- report

/// Probability from which an effect that is no member is listed.
inline constexpr double kReportedFrom = 0.01;
/// Probability of the best candidate of an unknown gap below which none is likely.
inline constexpr double kLikelyFrom = 0.2;
/// Probability of a candidate of an unknown gap from which its manoeuvre is advised.
inline constexpr double kToldFrom = 0.1;
/// Share of an effect's expected information that is left beside another one, below which both are confused.
inline constexpr double kConfusedBelow = 0.5;
/// Factor over the power of the nulls from which the closure of one channel is stated.
inline constexpr double kChannelGapFactor = 1.5;
/// Lower end of the closure's interval from which the floor is reported as too high.
inline constexpr double kOverClosedFrom = 1.02;
/// Distance between two surfacings from which position errors count, m: below it they are those of the fixes.
inline constexpr double kLeastDistance_m = 20;
/// Factor over the slow part of the nulls that a change of a channel's level must have.
inline constexpr double kLevelChangeFactor = 3;
/// Most reasons that a verdict states from what is left.
inline constexpr std::size_t kMostReasons = 4;

}  // namespace navcal::gap
