// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/document.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config/suggestion.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"

namespace navcal::sim {
namespace {

/// An effect that is being read.
struct Draft {
  std::unique_ptr<Effect> effect;
  std::vector<double> values;
  Interval when;
  unsigned line = 0;
  bool any = false;  ///< a parameter was given
};

std::optional<double> number(const config::Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value); real != nullptr && std::isfinite(*real)) return *real;
  return std::nullopt;
}

/// Empty when it was taken, else why not.
std::string take(Draft& draft, const std::string& key, const config::Value& value) {
  const auto given = number(value);
  if (!given) return "a number is expected, not " + config::words_for(value);
  if (key == "from_s" || key == "until_s") {
    (key == "from_s" ? draft.when.from_s : draft.when.until_s) = *given;
    return {};
  }
  const auto parameters = draft.effect->description().parameters;
  std::vector<std::string> known{"from_s", "until_s"};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    known.emplace_back(parameters[i].name);
    if (parameters[i].name != key) continue;
    draft.values[i] = *given;
    draft.any = true;
    return refusal(parameters[i], *given).value_or("");
  }
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return "unknown key" + config::suggestion(key, known) + ". Known are: " + list;
}

void check(const Draft& draft, std::vector<config::Problem>& problems) {
  const std::string name(draft.effect->description().name);
  if (!draft.any) problems.push_back({draft.line, name, "none of its parameters is given"});
  if (draft.when.from_s >= draft.when.until_s) {
    problems.push_back({draft.line, name, "until_s must lie after from_s"});
  }
}

}  // namespace

void add_effects(std::string_view toml, EffectSet& set, std::vector<config::Problem>& problems) {
  const std::size_t problems_before = problems.size();
  std::vector<Draft> drafts;
  for (const config::Entry& entry : config::read_document(toml, problems)) {
    const auto complain = [&](std::string what) {
      problems.push_back({entry.line, entry.name(), std::move(what)});
    };
    const bool table = std::holds_alternative<config::Table>(entry.value);
    if (entry.keys.size() == 1) {
      auto effect = make_effect(entry.keys[0]);
      if (!effect) {
        complain(unknown_effect(entry.keys[0]));
      } else if (!table) {
        complain("a table with its parameters is expected");
      } else {
        std::vector<double> zeros(effect->description().parameters.size());
        drafts.push_back({std::move(effect), std::move(zeros), {}, entry.line, false});
      }
      continue;
    }
    // Entries of a rejected table are skipped, and so are entries below a parameter.
    for (Draft& draft : drafts) {
      if (draft.effect->description().name != entry.keys[0] || entry.keys.size() > 2) continue;
      if (auto why = take(draft, entry.keys[1], entry.value); !why.empty()) complain(std::move(why));
    }
  }
  for (const Draft& draft : drafts) check(draft, problems);
  if (problems.size() > problems_before) return;
  for (Draft& draft : drafts) {
    draft.effect->set_parameters(draft.values);
    set.add(std::move(draft.effect), draft.when);
  }
}

}  // namespace navcal::sim
