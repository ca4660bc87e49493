// SPDX-License-Identifier: Apache-2.0
#include "validation/confusion.h"

#include <algorithm>
#include <map>
#include <utility>

#include "validation/confounded_effects.h"

namespace navcal::validation {
namespace {

using Counts = std::map<std::pair<std::string, std::string>, int>;

std::vector<std::string> truths_of(const TrialCase& drawn) {
  switch (drawn.arm) {
    case TrialArm::nulls: return {"no effect"};
    case TrialArm::nulls_6: return {"6 % off everywhere"};
    case TrialArm::removed: return {"removed from the library"};
    case TrialArm::foreign: return {"foreign to the library"};
    default: break;
  }
  std::vector<std::string> names;
  for (const TrialEffect& effect : drawn.effects) names.push_back(effect.full_name());
  return names;
}

void count_case(const TrialResult& result, Counts& counts) {
  const auto truths = truths_of(result.drawn);
  const auto is_there = [&](const std::string& name) { return std::ranges::find(truths, name) != truths.end(); };
  std::vector<std::string> named, wrong;
  if (result.answer) {
    for (const TrialFinding& finding : result.answer->effects) {
      named.push_back(finding.name);
      for (const TrialEffect& effect : result.drawn.effects)
        if (is_same(effect, finding.name)) named.back() = effect.full_name();
    }
  }
  std::ranges::copy_if(named, std::back_inserter(wrong), [&](const auto& name) { return !is_there(name); });
  for (const std::string& truth : truths) {
    std::vector<std::string> answers = wrong;
    if (!result.answer) {
      answers = {"no answer"};
    } else if (result.answer->verdict == TrialVerdict::no_gap) {
      answers = {"no gap"};
    } else if (result.answer->verdict != TrialVerdict::explained) {
      answers = {"unknown"};
    } else if (std::ranges::find(named, truth) != named.end()) {
      answers = {truth};
    } else if (wrong.empty()) {
      answers = {"left out"};
    }
    for (const std::string& answer : answers) ++counts[{truth, answer}];
  }
}

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const reference::EffectKind& kind : reference::library_effects()) names.emplace_back(kind.name);
  return names;
}

}  // namespace

int TrialConfusion::count(std::string_view truth, std::string_view answer) const {
  const auto row = std::ranges::find(truths, truth);
  const auto column = std::ranges::find(answers, answer);
  if (row == truths.end() || column == answers.end()) return 0;
  return counts[static_cast<std::size_t>(row - truths.begin())]
               [static_cast<std::size_t>(column - answers.begin())];
}

TrialConfusion trial_confusion(std::span<const TrialResult> results) {
  Counts counts;
  for (const TrialResult& result : results) {
    const TrialArm arm = result.drawn.arm;
    const bool weak = arm == TrialArm::single_tenth || arm == TrialArm::single_fifth;
    if (!weak && arm != TrialArm::poor) count_case(result, counts);
  }
  TrialConfusion confusion;
  const auto take = [&](std::vector<std::string>& list, std::vector<std::string> order, auto part) {
    for (const std::string& name : library_names()) order.push_back(name);
    // A diagnosis may answer a name that nobody knows.
    for (const auto& [pair, count] : counts) {
      if (std::ranges::find(order, part(pair)) == order.end()) order.push_back(part(pair));
    }
    for (const std::string& name : order) {
      const bool occurs =
          std::ranges::any_of(counts, [&](const auto& entry) { return part(entry.first) == name; });
      if (occurs) list.push_back(name);
    }
  };
  take(confusion.truths, {"no effect", "6 % off everywhere", "removed from the library", "foreign to the library"},
       [](const auto& pair) { return pair.first; });
  take(confusion.answers, {"no gap", "unknown", "no answer", "left out"},
       [](const auto& pair) { return pair.second; });
  for (const std::string& truth : confusion.truths) {
    confusion.counts.emplace_back();
    for (const std::string& answer : confusion.answers) {
      const auto found = counts.find({truth, answer});
      confusion.counts.back().push_back(found == counts.end() ? 0 : found->second);
    }
  }
  return confusion;
}

}  // namespace navcal::validation
