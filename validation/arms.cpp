// SPDX-License-Identifier: Apache-2.0
#include "validation/arms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace navcal::validation {
namespace {

using enum TrialArm;

constexpr std::array<TrialArmFacts, 13> kArms{{
    {nulls, "nulls", MissionKind::usual, 0, "no effect, 2 % off everywhere"},
    {nulls_6, "nulls-6", MissionKind::usual, 0, "no effect, 6 % off everywhere"},
    {single_tenth, "single-0.1", MissionKind::usual, 0.1, "one effect at 0.1 of its typical strength"},
    {single_fifth, "single-0.2", MissionKind::usual, 0.2, "one effect at 0.2 of its typical strength"},
    {single_half, "single-0.5", MissionKind::usual, 0.5, "one effect at half its typical strength"},
    {single, "single-1", MissionKind::usual, 1, "one effect at its typical strength"},
    {single_double, "single-2", MissionKind::usual, 2, "one effect at twice its typical strength"},
    {pairs, "pairs", MissionKind::usual, 1, "two effects, by turns any two and two easily confounded"},
    {triples, "triples", MissionKind::usual, 1, "three effects"},
    {brief, "short", MissionKind::brief, 1, "one effect, missions of three minutes"},
    {removed, "removed", MissionKind::usual, 1, "one effect that is taken out of the library"},
    {foreign, "foreign", MissionKind::usual, 1, "one effect that no library holds"},
    {poor, "poor", MissionKind::poor, 1, "one effect, straight missions without excitation"},
}};

// Every arm comes early, and the nulls come evenly.
constexpr std::array<TrialArm, kCasesPerRound> kRound{
    nulls,       single, pairs,  nulls,   foreign, brief,        nulls,        single_fifth,
    removed,     nulls,  poor,   nulls,   triples, single_tenth, nulls,        nulls_6,
    single_half, nulls,  single, foreign, nulls,   pairs,        nulls,        brief,
    removed,     nulls,  poor,   triples, nulls,   single_fifth, single_tenth, single_double};

}  // namespace

std::span<const TrialArmFacts> trial_arms() { return kArms; }

const TrialArmFacts& facts_of(TrialArm arm) { return kArms[static_cast<std::size_t>(arm)]; }

TrialArm arm_of_case(int number) { return kRound[static_cast<std::size_t>((number - 1) % kCasesPerRound)]; }

int ordinal_in_arm(int number) {
  const TrialArm arm = arm_of_case(number);
  const int rounds = (number - 1) / kCasesPerRound, place = (number - 1) % kCasesPerRound;
  const auto in_round = std::count(kRound.begin(), kRound.end(), arm);
  return static_cast<int>(rounds * in_round + std::count(kRound.begin(), kRound.begin() + place, arm));
}

std::vector<TrialArm> trial_arms_named(const std::vector<std::string>& names) {
  std::vector<TrialArm> arms;
  for (const TrialArmFacts& facts : kArms) {
    if (names.empty()) arms.push_back(facts.arm);
  }
  for (const std::string& name : names) {
    const std::size_t before = arms.size();
    std::string known;
    for (const TrialArmFacts& facts : kArms) {
      const bool meant = facts.name == name || (name == "singles" && facts.name.starts_with("single-"));
      if (meant) arms.push_back(facts.arm);
      known.append(known.empty() ? "" : ", ").append(facts.name);
    }
    if (arms.size() == before)
      throw std::invalid_argument(fmt::format("there is no arm {}; there are {}", name, known));
  }
  return arms;
}

std::vector<int> case_numbers(const std::vector<TrialArm>& arms, int count) {
  std::vector<int> numbers;
  for (int number = 1; !arms.empty() && static_cast<int>(numbers.size()) < count; ++number) {
    if (std::find(arms.begin(), arms.end(), arm_of_case(number)) != arms.end()) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace navcal::validation
