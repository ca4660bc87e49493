// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// Numbers that decide what a fleet's answer names. Strengths are in typical values of an effect. "Set" is what
/// was chosen and not derived.
namespace navcal::fleet {

/// Standard deviation of each parameter of one vehicle without a gap: the definition of docs/gap.md.
inline constexpr double kVehicleTolerance = 0.02;
/// The same of what all vehicles of a design have in common. Set: half of that, since a design is checked on more
/// than one vehicle.
inline constexpr double kDesignTolerance = 0.01;
/// The same of water and field from day to day.
inline constexpr double kDayTolerance = 0.02;
/// Effects that belong to the water, or to the Earth's field at the place: all vehicles of a day share them.
inline constexpr std::array<std::string_view, 4> kOfSurroundings{"buoyancy", "declination", "depth_scale",
                                                                 "water_current"};
/// Those that cannot belong to a vehicle at all.
inline constexpr std::array<std::string_view, 2> kNeverOfVehicle{"declination", "water_current"};
/// Standard deviations of the prior of a cause's strength, each as likely as the others. The smallest is for weak
/// effects that only many missions show.
inline constexpr std::array<double, 4> kCauseStrengths{0.05, 0.2, 0.6, 2};
/// Log evidence that each cause costs beside its prior, nats. Set, as for the first effect of one recording.
inline constexpr double kCauseCost_nats = 3;
/// Probability from which a cause, its level and its unit are named. Set.
inline constexpr double kCauseNamedFrom = 0.9;
/// Gain by which another cause takes the place of one that was found, nats: below it both are as good.
inline constexpr double kReplaced_nats = 1;
/// Rounds in which each cause is compared with all others.
inline constexpr int kExchangeRounds = 3;
/// Most causes of one vehicle. Set: an effect that is not in the library is imitated by one more cause after the
/// other.
inline constexpr std::size_t kMostCausesPerVehicle = 3;
/// Strength up to which an effect is a tolerance of a vehicle: 2.5 standard deviations; of a design or a day by
/// theirs.
inline constexpr double kToleranceDeviations = 2.5;
/// Strength of a cause beside a backlash in the same missions, in strengths of the backlash, up to which the cause
/// is not named: of the same vehicle or design, and of another one. Set: inside its dead band a fin is not where
/// the linear model has it, and effects of other instruments imitate the difference.
inline constexpr double kBesideOwnBacklash = 2, kBesideBacklash = 0.7;
/// Standard deviations of the floor above which the missions of a vehicle show a gap.
inline constexpr double kFleetGap_sigma = 4;
/// Share of its gap that the causes must close, or the vehicle has an unknown cause.
inline constexpr double kFleetClosedFrom = 0.9;
/// Probability of an alternative from which it is listed.
inline constexpr double kAlternativeFrom = 0.01;
/// Distance of two first fixes within which two missions of a date are in the same water, m.
inline constexpr double kSameWater_m = 20e3;
/// Resamples of a bootstrap: its 2.5 % quantile rests on 25 of them.
inline constexpr int kFleetResamples = 1000;

}  // namespace navcal::fleet
