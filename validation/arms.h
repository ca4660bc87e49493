// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::validation {

/// Kinds of cases in a trial.
enum class TrialArm : std::uint8_t {
  nulls,         ///< no effect: the vehicle is off by 2 % everywhere, as all vehicles of a trial are
  nulls_6,       ///< no effect, off by 6 % everywhere: a gap without one cause
  single_tenth,  ///< one effect at a tenth of its typical strength, and so on
  single_fifth,
  single_half,
  single,
  single_double,
  pairs,    ///< two effects: by turns any two, and two that are easily taken for one another
  triples,  ///< three
  brief,    ///< one effect, missions of three minutes
  removed,  ///< one effect that the library is to be without
  foreign,  ///< one effect that no library holds
  poor,     ///< one effect, straight missions without excitation
};

/// The three missions of a case; each kind asks for null missions of its own.
enum class MissionKind : std::uint8_t { usual, brief, poor };

struct TrialArmFacts {
  TrialArm arm;
  std::string_view name;  ///< as `--arms` and the report have it
  MissionKind missions;
  double strength;  ///< of each effect; 0 where there is none
  std::string_view what;
};

[[nodiscard]] std::span<const TrialArmFacts> trial_arms();
[[nodiscard]] const TrialArmFacts& facts_of(TrialArm arm);

/// Arms of the cases in the order of their numbers, over and over: a case's arm follows from its number alone, so
/// that it is the same case in a trial of any length.
using TrialRound = std::span<const TrialArm>;
/// The round of the reference vehicle: 11 nulls; one each of nulls-6, single-0.5, single-2; two each of the
/// others. 17 rounds give each of these 34 cases, as many as there are effects.
inline constexpr int kCasesPerRound = 32;
[[nodiscard]] TrialRound reference_round();
/// The round of vehicles with a layout: 16 cases, five of them nulls.
[[nodiscard]] TrialRound layout_round();

[[nodiscard]] TrialArm arm_of_case(int number, TrialRound round = reference_round());
/// How many cases of the same arm have lower numbers.
[[nodiscard]] int ordinal_in_arm(int number, TrialRound round = reference_round());

/// Names of arms of a round ("singles" stands for all strengths); none: all. Throws std::invalid_argument, which
/// lists them.
[[nodiscard]] std::vector<TrialArm> trial_arms_named(const std::vector<std::string>& names,
                                                     TrialRound round = reference_round());
/// The first `count` case numbers that belong to these arms.
[[nodiscard]] std::vector<int> case_numbers(const std::vector<TrialArm>& arms, int count,
                                            TrialRound round = reference_round());

}  // namespace navcal::validation
