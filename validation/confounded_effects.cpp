// SPDX-License-Identifier: Apache-2.0
#include "validation/confounded_effects.h"

#include <algorithm>
#include <array>

#include "base/enum_name.h"
#include "base/line_reader.h"
#include "base/text_rows.h"
#include "sim/effects/effect_table.h"
#include "validation/reference/effects.h"

namespace navcal::validation {

/// Channels and sources of each reference::Trace, by the equations: a lag of the field or a turned magnetometer is
/// an error of both field and heading, and what acts on the whole inertial card is one of each of its instruments.
/// Families of the quantities in each foreign effect's equation (docs/trial.md). Pairs of effects of a vehicle
/// with thrusters that leave nearly the same traces.
const char* signature_rows();  // signatures.txt

namespace {

using Words = std::vector<std::string_view>;

/// The words of each row that begins with `key`.
std::vector<Words> rows_of(std::string_view key) {
  std::vector<Words> found;
  for (auto [first, words] : base::text_rows(signature_rows(), ": ")) {
    if (first != key) continue;
    found.emplace_back();
    while (!words.empty()) found.back().push_back(base::take_until(words, " "));
  }
  return found;
}

Words row_of(std::string_view kind, std::string_view name) {
  return rows_of(std::string(kind).append(" of ").append(name)).at(0);
}

TrialSignature signature(const reference::EffectKind& kind) {
  const std::string_view trace = base::enum_name<reference::Trace::waves>(
      kind.trace, {"field", "heading", "tilt", "roll", "rates", "force", "card", "depth", "fixes", "drift",
                   "thrust", "fins", "rise", "supply", "waves"});
  return {kind.name, {}, row_of("channels", trace), row_of("sources", trace), {}};
}

std::vector<TrialSignature> all_signatures() {
  std::vector<TrialSignature> all;
  for (const reference::EffectKind& kind : reference::library_effects()) {
    all.push_back(signature(kind));
    if (const auto effect = sim::make_effect(kind.name)) {
      const auto confounders = effect->description().confounders;
      all.back().confounders.assign(confounders.begin(), confounders.end());
    }
  }
  for (const reference::EffectKind& kind : reference::foreign_effects()) {
    all.push_back(signature(kind));
    all.back().families = row_of("families", kind.name);
  }
  return all;
}

/// Effects of a vehicle with thrusters that leave nearly the same traces.
bool is_pair(std::string_view a, std::string_view b) {
  static const std::vector<Words> kPairs = rows_of("pair");
  return std::ranges::any_of(kPairs, [&](const Words& pair) {
    return pair == Words{a, b} || pair == Words{b, a};
  });
}

/// "thrust_scale" and "thruster.2" of "thrust_scale of thruster.2".
std::array<std::string_view, 2> parts_of(std::string_view full_name) {
  constexpr std::string_view kOf = " of ";
  const std::size_t at = full_name.find(kOf);
  if (at == std::string_view::npos) return {full_name, {}};
  return {full_name.substr(0, at), full_name.substr(at + kOf.size())};
}

bool belongs(const TrialEffect& effect, std::string_view of) {
  return of == effect.of || (!of.empty() && of == effect.of_name);
}

}  // namespace

bool is_same(const TrialEffect& effect, std::string_view full_name) {
  const auto [name, of] = parts_of(full_name);
  return name == effect.name && belongs(effect, of);
}

bool is_confounded(const TrialEffect& effect, std::string_view full_name) {
  const auto [name, of] = parts_of(full_name);
  if (name == effect.name) return belongs(effect, of);
  if ((!effect.of.empty() && belongs(effect, of)) || is_pair(effect.name, name)) return true;
  const TrialSignature* const signature = signature_of(effect.name);
  return signature != nullptr && std::ranges::find(signature->confounders, name) != signature->confounders.end();
}

std::span<const TrialSignature> trial_signatures() {
  static const std::vector<TrialSignature> all = all_signatures();
  return all;
}

const TrialSignature* signature_of(std::string_view effect) {
  const auto all = trial_signatures();
  const auto found = std::ranges::find_if(all, [&](const auto& s) { return s.effect == effect; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<ConfoundedEffects> confounded_pairs() {
  std::vector<ConfoundedEffects> pairs;
  for (const TrialSignature& signature : trial_signatures()) {
    for (const std::string_view other : signature.confounders) {
      const bool known = std::ranges::any_of(pairs, [&](const ConfoundedEffects& pair) {
        return pair.first == other && pair.second == signature.effect;
      });
      if (!known) pairs.push_back({signature.effect, other});
    }
  }
  return pairs;
}

}  // namespace navcal::validation
