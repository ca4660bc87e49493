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

constexpr std::array kLayoutRound{nulls, single, removed, single,        nulls, foreign, single_half, single,
                                  nulls, pairs,  nulls,   single_double, nulls, removed, single,      foreign};

bool has(std::span<const TrialArm> arms, TrialArm arm) { return std::ranges::find(arms, arm) != arms.end(); }

}  // namespace

std::span<const TrialArmFacts> trial_arms() { return kArms; }

const TrialArmFacts& facts_of(TrialArm arm) { return kArms[static_cast<std::size_t>(arm)]; }

TrialRound reference_round() { return kRound; }

TrialRound layout_round() { return kLayoutRound; }

TrialArm arm_of_case(int number, TrialRound round) {
  return round[static_cast<std::size_t>(number - 1) % round.size()];
}

int ordinal_in_arm(int number, TrialRound round) {
  const TrialArm arm = arm_of_case(number, round);
  const auto size = static_cast<std::ptrdiff_t>(round.size());
  const std::ptrdiff_t rounds = (number - 1) / size, place = (number - 1) % size;
  const auto in_round = std::ranges::count(round, arm);
  return static_cast<int>(rounds * in_round + std::count(round.begin(), round.begin() + place, arm));
}

std::vector<TrialArm> trial_arms_named(const std::vector<std::string>& names, TrialRound round) {
  std::vector<TrialArm> arms;
  for (const std::string& name : names.empty() ? std::vector<std::string>{""} : names) {
    const std::size_t before = arms.size();
    std::string known;
    for (const TrialArmFacts& facts : kArms) {
      if (!has(round, facts.arm)) continue;
      const bool meant =
          name.empty() || facts.name == name || (name == "singles" && facts.name.starts_with("single-"));
      if (meant) arms.push_back(facts.arm);
      known.append(known.empty() ? "" : ", ").append(facts.name);
    }
    if (arms.size() == before)
      throw std::invalid_argument(fmt::format("there is no arm {}; there are {}", name, known));
  }
  return arms;
}

std::vector<int> case_numbers(const std::vector<TrialArm>& arms, int count, TrialRound round) {
  std::vector<int> numbers;
  for (int number = 1; !arms.empty() && static_cast<int>(numbers.size()) < count; ++number) {
    if (has(arms, arm_of_case(number, round))) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace navcal::validation
