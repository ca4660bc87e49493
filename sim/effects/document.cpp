// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/document.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "config/complaints.h"
#include "sim/effects/choice.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::sim {
namespace {

/// An effect that is being read: of instruments, lines and the vehicle, or of a layout.
struct Draft {
  std::unique_ptr<Effect> effect;
  LayoutEffect of_layout{};
  std::vector<EffectParameter> parameters;
  std::vector<double> values{};
  Interval when{};
  std::string name{};  ///< of the table in the file
  unsigned line = 0;
  bool any = false;  ///< a parameter was given
};

std::optional<double> number(const config::Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value); real != nullptr && std::isfinite(*real)) return *real;
  return std::nullopt;
}

/// Empty when it was taken, else why not.
std::string take_owner(Draft& draft, const config::Value& value, const config::Layout& layout) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return "a text is expected, such as \"thruster.2\", not " + config::words_for(value);
  draft.of_layout.of = *text;
  return owner_refusal(layout, *draft.of_layout.about, *text).value_or("");
}

/// Empty when it was taken, else why not.
std::string take(Draft& draft, const std::string& key, const config::Value& value, const config::Layout* layout) {
  const bool has_owner = draft.of_layout.about != nullptr && draft.of_layout.about->part != LayoutPart::vehicle;
  if (key == "of" && draft.of_layout.about != nullptr) return take_owner(draft, value, *layout);
  const auto given = number(value);
  if (!given) return "a number is expected, not " + config::words_for(value);
  if (key == "from_s" || key == "until_s") {
    (key == "from_s" ? draft.when.from_s : draft.when.until_s) = *given;
    return {};
  }
  std::vector<std::string> known{"from_s", "until_s"};
  if (has_owner) known.emplace_back("of");
  for (std::size_t i = 0; i < draft.parameters.size(); ++i) {
    known.emplace_back(draft.parameters[i].name);
    if (draft.parameters[i].name != key) continue;
    draft.values[i] = *given;
    draft.any = true;
    return refusal(draft.parameters[i], *given).value_or("");
  }
  return "unknown key" + config::suggestion_or_all(key, known);
}

/// Reads the tables of a document into drafts.
class DraftReader {
 public:
  DraftReader(const config::Layout* layout, std::vector<config::Problem>& problems)
      : layout_(layout), problems_(problems) {}

  void read(const config::Node& node) {
    const LayoutEffectDescription* about = layout_ != nullptr ? find_layout_effect(node.key) : nullptr;
    auto effect = about != nullptr ? nullptr : make_effect(node.key);
    if (about == nullptr && !effect) return complain(node, unknown_effect(node.key, layout_ != nullptr));
    if (!std::holds_alternative<config::Table>(node.value) || (node.is_list && about == nullptr))
      return complain(node, "a table with its parameters is expected");
    if (effect && layout_ != nullptr) {
      if (auto why = refusal_for_layout(effect->description())) return complain(node, std::move(*why));
    }
    if (node.is_list) {
      for (const config::Node& table : node.children) read_layout_effect(*about, table);
    } else if (about != nullptr) {
      read_layout_effect(*about, node);
    } else {
      read_effect(std::move(effect), node);
    }
  }
  [[nodiscard]] std::vector<Draft>& drafts() { return drafts_; }

 private:
  void complain(const config::Node& node, std::string what) {
    problems_.push_back({node.line, node.name, std::move(what)});
  }
  void read_effect(std::unique_ptr<Effect> effect, const config::Node& table) {
    const auto parameters = effect->description().parameters;
    drafts_.push_back({std::move(effect), {}, {parameters.begin(), parameters.end()}});
    read_keys(table);
  }
  void read_layout_effect(const LayoutEffectDescription& about, const config::Node& table) {
    drafts_.push_back({nullptr, {&about, {}, {}}, {about.parameters.begin(), about.parameters.end()}});
    read_keys(table);
    if (drafts_.back().of_layout.of.empty()) {
      if (auto why = owner_refusal(*layout_, about, {})) complain(table, std::move(*why));
    }
  }
  void read_keys(const config::Node& table) {
    Draft& draft = drafts_.back();
    draft.values.resize(draft.parameters.size());
    draft.name = table.name;
    draft.line = table.line;
    for (const config::Node& key : table.children) {
      if (auto why = take(draft, key.key, key.value, layout_); !why.empty()) complain(key, std::move(why));
    }
  }

  const config::Layout* layout_;
  std::vector<config::Problem>& problems_;
  std::vector<Draft> drafts_;
};

void check(const Draft& draft, std::vector<config::Problem>& problems) {
  if (!draft.any) problems.push_back({draft.line, draft.name, "none of its parameters is given"});
  if (draft.when.from_s >= draft.when.until_s) {
    problems.push_back({draft.line, draft.name, "until_s must lie after from_s"});
  }
}

}  // namespace

void add_effects(std::string_view toml, EffectSet& set, std::vector<config::Problem>& problems,
                 const config::Layout* layout) {
  const std::size_t problems_before = problems.size();
  const config::Node root = config::read_tree(toml, problems);
  DraftReader reader(layout, problems);
  for (const config::Node& node : root.children) reader.read(node);
  for (const Draft& draft : reader.drafts()) check(draft, problems);
  if (problems.size() > problems_before) return;
  for (Draft& draft : reader.drafts()) {
    if (draft.effect) {
      draft.effect->set_parameters(draft.values);
      set.add(std::move(draft.effect), draft.when);
    } else {
      draft.of_layout.values = std::move(draft.values);
      set.add(std::move(draft.of_layout), draft.when);
    }
  }
}

}  // namespace navcal::sim
