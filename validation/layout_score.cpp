// SPDX-License-Identifier: Apache-2.0
#include "validation/layout_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "validation/confounded_effects.h"

namespace navcal::validation {
namespace {

using LayoutJson = nlohmann::json;

constexpr std::array<std::string_view, kLayoutOutcomes> kLayoutOutcomeNames{
    "exact", "part", "class", "wrong name", "unknown", "cannot say", "no gap", "failed"};

struct NamedEffect {
  std::string_view name, of;
};

NamedEffect parts_of(std::string_view full_name) {
  constexpr std::string_view kOf = " of ";
  const std::size_t at = full_name.find(kOf);
  if (at == std::string_view::npos) return {full_name, {}};
  return {full_name.substr(0, at), full_name.substr(at + kOf.size())};
}

bool belongs(const LayoutTruth::Present& present, std::string_view of) {
  return of == present.of || (!of.empty() && of == present.of_name);
}

bool is_same(const LayoutTruth::Present& present, std::string_view full_name) {
  const NamedEffect named = parts_of(full_name);
  return named.name == present.name && belongs(present, named.of);
}

bool is_pair(std::string_view a, std::string_view b) {
  using Pair = std::array<std::string_view, 2>;
  constexpr std::array<Pair, 8> kPairs{{{"weight", "buoyancy"},
                                        {"weight", "gravity_shift"},
                                        {"buoyancy", "gravity_shift"},
                                        {"gravity_shift", "tilt_offset"},
                                        {"damping", "thrust_scale"},
                                        {"damping", "water_current"},
                                        {"added_mass", "weight"},
                                        {"thruster_offset", "buoyancy"}}};
  return std::any_of(kPairs.begin(), kPairs.end(), [&](const Pair& pair) {
    return (pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a);
  });
}

/// Calls on(object) for each line; errors name the line.
void each_line(std::string_view lines, const std::function<void(const LayoutJson&, std::string_view)>& on) {
  int number = 0;
  while (!lines.empty()) {
    ++number;
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    lines.remove_prefix(std::min(end + 1, lines.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    try {
      on(LayoutJson::parse(line), line);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("line {}: {}", number, error.what()));
    }
  }
}

LayoutTruth::Present present_of(const LayoutJson& object) {
  LayoutTruth::Present present;
  present.name = object.at("name").get<std::string>();
  present.of = object.value("of", "");
  present.of_name = object.value("of_name", "");
  for (const auto& [key, value] : object.at("parameters").items()) present.parameters[key] = value.get<double>();
  return present;
}

struct JudgedLayout {
  const LayoutTruth* truth;
  const LayoutAnswer* answer;  ///< nullptr: none
  LayoutOutcome outcome;
};

bool is_as_asked(const JudgedLayout& one) {
  using enum LayoutOutcome;
  switch (one.truth->arm) {
    case LayoutArm::nulls: return one.outcome == no_gap;
    case LayoutArm::foreign: return one.outcome == unknown || one.outcome == cannot_say;
    case LayoutArm::removed: return one.outcome == unknown || one.outcome == cannot_say || one.outcome == in_class;
    default: return one.outcome == exact;
  }
}

/// Those of exact outcomes that lie within two standard errors of the truth, and all.
std::array<int, 2> parameters_within(const JudgedLayout& one) {
  std::array<int, 2> counts{};
  if (one.outcome != LayoutOutcome::exact) return counts;
  for (const TrialFinding& finding : one.answer->answer->effects) {
    for (const LayoutTruth::Present& present : one.truth->effects)
      if (is_same(present, finding.name)) count_within(finding, present.parameters, counts[0], counts[1]);
  }
  return counts;
}

class LayoutTable : public ScoreTable<JudgedLayout> {
 public:
  using ScoreTable::ScoreTable, ScoreTable::share;
  using Hit = std::function<bool(const JudgedLayout&)>;
  void share(LayoutArm arm, std::string_view what, TrialTarget target, const Hit& hit) {
    share(fmt::format("{}: {}", name_of(arm), what), target,
          [&](const JudgedLayout& one) { return one.truth->arm == arm ? std::optional(hit(one)) : std::nullopt; });
  }
};

LayoutTable::Hit is(LayoutOutcome outcome) {
  return [outcome](const JudgedLayout& one) { return one.outcome == outcome; };
}

void score_all(const std::vector<JudgedLayout>& all, std::vector<TrialScore>& scores) {
  using enum LayoutOutcome;
  LayoutTable table(all, scores);
  table.share(LayoutArm::nulls, "flagged", {{}, 0.02}, [](const JudgedLayout& one) {
    return one.outcome != failed && one.outcome != no_gap && one.outcome != cannot_say;
  });
  table.share(LayoutArm::nulls, "an effect named", {}, is(wrong));
  for (const LayoutArm arm : {LayoutArm::single, LayoutArm::single_double, LayoutArm::single_half}) {
    table.share(arm, "exact", {0.95, {}}, is(exact));
    table.share(arm, "exact, or its class", {},
                [](const JudgedLayout& one) { return one.outcome == exact || one.outcome == in_class; });
    table.share(arm, "wrong name", {{}, 0.01}, is(wrong));
  }
  table.share(LayoutArm::pairs, "exact", {0.9, {}}, is(exact));
  table.share(LayoutArm::removed, "unknown, cannot say, or its class", {0.85, {}}, is_as_asked);
  table.share(LayoutArm::foreign, "unknown, or cannot say", {0.97, {}}, is_as_asked);
  table.parts("parameters within 2 standard errors", {0.95, {}}, parameters_within);
  std::vector<double> closures;
  for (const JudgedLayout& one : all)
    if (one.outcome == exact && one.answer->answer->closed) closures.push_back(*one.answer->answer->closed);
  table.closures(closures);
  table.LayoutTable::ScoreTable::share("no answer", {{}, 0.0}, is(failed));
}

}  // namespace

std::string_view name_of(LayoutOutcome outcome) { return kLayoutOutcomeNames[static_cast<std::size_t>(outcome)]; }

std::vector<LayoutTruth> read_layout_truths(std::string_view lines) {
  std::vector<LayoutTruth> truths;
  each_line(lines, [&](const LayoutJson& object, std::string_view /*line*/) {
    if (!object.contains("case")) return;
    LayoutTruth truth;
    truth.number = fmt::format("{:04}", object.at("case").get<int>());
    truth.arm = layout_arm_named(object.at("arm").get<std::string>());
    truth.excluded = object.at("excluded").get<std::string>();
    for (const LayoutJson& effect : object.at("effects")) truth.effects.push_back(present_of(effect));
    truths.push_back(std::move(truth));
  });
  return truths;
}

std::vector<LayoutAnswer> read_layout_answers(std::string_view lines) {
  std::vector<LayoutAnswer> answers;
  each_line(lines, [&](const LayoutJson& object, std::string_view line) {
    LayoutAnswer answer;
    answer.number = object.at("case").get<std::string>();
    if (!object.contains("failure")) {
      answer.cannot_say = object.at("verdict") == "cannot-say";
      if (!answer.cannot_say) answer.answer = read_answer(line);
    }
    answers.push_back(std::move(answer));
  });
  return answers;
}

bool is_confounded(const LayoutTruth::Present& present, std::string_view full_name) {
  const NamedEffect named = parts_of(full_name);
  if (named.name == present.name) return belongs(present, named.of);
  if (!present.of.empty() && belongs(present, named.of)) return true;
  if (is_pair(present.name, named.name)) return true;
  const TrialSignature* const signature = signature_of(present.name);
  return signature != nullptr && std::find(signature->confounders.begin(), signature->confounders.end(),
                                           named.name) != signature->confounders.end();
}

LayoutOutcome outcome_of(const LayoutTruth& truth, const LayoutAnswer& given) {
  if (given.cannot_say) return LayoutOutcome::cannot_say;
  if (!given.answer) return LayoutOutcome::failed;
  const TrialAnswer& answer = *given.answer;
  if (answer.verdict == TrialVerdict::no_gap) return LayoutOutcome::no_gap;
  if (answer.verdict == TrialVerdict::unknown) return LayoutOutcome::unknown;
  const auto is_there = [&](const TrialFinding& finding) {
    return std::any_of(truth.effects.begin(), truth.effects.end(),
                       [&](const auto& present) { return is_same(present, finding.name); });
  };
  const auto in_class = [&](const TrialFinding& finding) {
    return std::any_of(truth.effects.begin(), truth.effects.end(), [&](const LayoutTruth::Present& present) {
      const bool is_said = std::any_of(answer.twins.begin(), answer.twins.end(),
                                       [&](const std::string& twin) { return is_same(present, twin); });
      return is_said || is_same(present, finding.name) || is_confounded(present, finding.name);
    });
  };
  const auto& named = answer.effects;
  const bool can_be_named = truth.excluded.empty() && truth.arm != LayoutArm::foreign;
  if (can_be_named && std::all_of(named.begin(), named.end(), is_there))
    return named.size() == truth.effects.size() ? LayoutOutcome::exact : LayoutOutcome::part;
  if (truth.arm != LayoutArm::foreign && std::all_of(named.begin(), named.end(), in_class))
    return LayoutOutcome::in_class;
  return LayoutOutcome::wrong;
}

LayoutScores layout_scores(const std::vector<LayoutTruth>& truths, const std::vector<LayoutAnswer>& answers) {
  std::map<std::string, const LayoutAnswer*, std::less<>> by_number;
  for (const LayoutAnswer& answer : answers) {
    if (!by_number.emplace(answer.number, &answer).second)
      throw std::runtime_error(fmt::format("case {} is answered twice", answer.number));
  }
  LayoutScores scores;
  std::vector<JudgedLayout> all;
  for (const LayoutTruth& truth : truths) {
    const auto found = by_number.find(truth.number);
    JudgedLayout one{&truth, found == by_number.end() ? nullptr : found->second, LayoutOutcome::failed};
    if (one.answer != nullptr) {
      one.outcome = outcome_of(truth, *one.answer);
      by_number.erase(found);
      ++scores.answered;
    }
    ++scores.outcomes[static_cast<std::size_t>(truth.arm)][static_cast<std::size_t>(one.outcome)];
    all.push_back(one);
  }
  if (!by_number.empty())
    throw std::runtime_error(
        fmt::format("case {} is answered, but the truth has no such case", by_number.begin()->first));
  scores.cases = static_cast<int>(all.size());
  score_all(all, scores.scores);
  return scores;
}

}  // namespace navcal::validation
