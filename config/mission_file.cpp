// SPDX-License-Identifier: Apache-2.0
#include "config/mission_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "config/complaints.h"
#include "config/mission_options.h"
#include "config/option_lookup.h"

namespace navcal::config {
namespace {

constexpr std::string_view kStep = "step";

/// A [[step]] as it stands in the file.
struct StepEntries {
  Entry table;
  std::vector<Entry> keys;
};

bool is_step(const std::string& key) { return key.starts_with("step[") && key.ends_with(']'); }

std::vector<std::string> words_of(const StepRule& rule) {
  std::vector<std::string> words{"do"};
  for (const auto* groups : {&rule.required, &rule.optional}) {
    for (const auto& group : *groups) {
      for (const std::string_view key : group) {
        if (std::find(words.begin(), words.end(), key) == words.end()) words.emplace_back(key);
      }
    }
  }
  return words;
}

class StepReader {
 public:
  StepReader(const StepEntries& entries, std::vector<Problem>& problems)
      : entries_(entries), problems_(problems) {}

  MissionStep read() {
    MissionStep step;
    step.line = entries_.table.line;
    const Entry* kind = find("do");
    const Option<MissionStep>& choice = step_options().front();
    if (kind == nullptr) {
      complain(entries_.table, "do is missing; known: " + choice.allowed());
    } else if (auto refused = set(choice, step, *kind)) {
      complain(*kind, std::move(*refused));
    } else {
      take_keys(step);
      check_groups(rule_of(step.kind));
    }
    return step;
  }

 private:
  [[nodiscard]] const Entry* find(std::string_view key) const {
    const auto found = std::find_if(entries_.keys.begin(), entries_.keys.end(),
                                    [&](const Entry& entry) { return entry.keys[1] == key; });
    return found == entries_.keys.end() ? nullptr : &*found;
  }

  void take_keys(MissionStep& step) {
    const auto known = words_of(rule_of(step.kind));
    for (const Entry& entry : entries_.keys) {
      const std::string& key = entry.keys[1];
      if (key == "do" || entry.keys.size() > 2) continue;
      const auto* option = config::find(step_options(), "", key);
      if (option == nullptr) {
        complain(entry, "unknown key" + suggestion(key, known));
      } else if (std::find(known.begin(), known.end(), key) == known.end()) {
        complain(entry, fmt::format("a {} has no such key; it takes {}", kind_name(step.kind),
                                    fmt::join(known.begin() + 1, known.end(), ", ")));
      } else if (auto refused = set(*option, step, entry)) {
        complain(entry, std::move(*refused));
      }
    }
  }

  void check_groups(const StepRule& rule) {
    for (const auto& group : rule.required) {
      if (said_of(group) == 0) complain(entries_.table, fmt::format("{} is missing", fmt::join(group, " or ")));
    }
    for (const auto* groups : {&rule.required, &rule.optional}) {
      for (const auto& group : *groups) {
        if (said_of(group) > 1)
          complain(entries_.table, fmt::format("only one of {} may be given", fmt::join(group, " and ")));
      }
    }
  }

  [[nodiscard]] std::ptrdiff_t said_of(const std::vector<std::string_view>& group) const {
    return std::count_if(group.begin(), group.end(), [&](std::string_view key) { return find(key) != nullptr; });
  }

  static std::string_view kind_name(StepKind kind) {
    return step_options().front().choices.at(static_cast<std::size_t>(kind));
  }

  void complain(const Entry& entry, std::string message) {
    problems_.push_back({entry.line, entry.name(), std::move(message)});
  }

  const StepEntries& entries_;
  std::vector<Problem>& problems_;
};

bool is_file(const std::string& name) { return name.ends_with(".toml") || name.find('/') != std::string::npos; }

}  // namespace

Mission parse_mission(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  Mission mission;
  std::vector<StepEntries> steps;
  const auto entries = read_document(toml, problems, kStep);
  const bool readable = problems.empty();
  for (const Entry& entry : entries) {
    const std::string& table = entry.keys.front();
    if (is_step(table)) {
      if (steps.empty() || steps.back().table.keys.front() != table) {
        steps.push_back({{{table}, Table{}, entry.line, std::nullopt}, {}});
      }
      if (entry.keys.size() > 1) steps.back().keys.push_back(entry);
    } else if (table == kStep) {
      if (entry.keys.size() == 1) problems.push_back({entry.line, "step", "tables [[step]] are expected"});
    } else if (auto refused = take_entry(mission_options(), mission, entry, {std::string(kStep)})) {
      problems.push_back({entry.line, entry.name(), std::move(*refused)});
    }
  }
  for (const StepEntries& step : steps) mission.steps.push_back(StepReader(step, problems).read());
  if (readable && steps.empty()) problems.push_back({1, "step", "a mission has a [[step]] or more"});
  refuse(std::move(problems), name);
  return mission;
}

Mission load_mission(const std::string& name_or_file) {
  if (is_file(name_or_file)) return parse_mission(content_of(name_or_file), name_or_file);
  std::vector<std::string> names;
  for (const ShippedMission& shipped : shipped_missions()) {
    if (shipped.name == name_or_file) return parse_mission(shipped.toml, name_or_file);
    names.emplace_back(shipped.name);
  }
  throw Error({fmt::format("there is no mission {}{} (a file has a / or ends in .toml)", name_or_file,
                           suggestion_or_all(name_or_file, names))});
}

}  // namespace navcal::config
