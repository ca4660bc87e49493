// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "report/gap_report.h"
#include "report/gap_words.h"
#include "report/wrapped_text.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::report {
namespace {

struct Written {
  double value = 0;
  std::string comment;
};

Written written(const gap::EffectParameterEstimate& estimate, std::span<const sim::EffectParameter> known) {
  if (!std::isfinite(estimate.value)) return {0, "not determined"};
  const std::string error =
      std::isfinite(estimate.std_error) ? fmt::format("+- {:.2g}", estimate.std_error) : "error not known";
  const auto found = std::ranges::find(known, estimate.name, &sim::EffectParameter::name);
  if (found == known.end()) return {estimate.value, error};
  const double within = std::clamp(estimate.value, found->least, found->greatest);
  if (within == estimate.value) return {within, error};
  return {within, fmt::format("{:.4g} {}, outside the range of the simulator", estimate.value, error)};
}

void append_parameters(std::string& text, const gap::EffectFinding& effect,
                       std::span<const sim::EffectParameter> known) {
  for (const auto& estimate : effect.parameters) {
    const auto [value, comment] = written(estimate, known);
    fmt::format_to(std::back_inserter(text), "{} = {}  # {}\n", estimate.name, value, comment);
  }
}

}  // namespace

std::string gap_effects_file(const gap::Diagnosis& diagnosis) {
  std::string text =
      fmt::format("# navcal gap: {}.\n# For navcal simulate --effects.\n", verdict_word(diagnosis.verdict));
  if (diagnosis.effects.empty()) return text + "# No effect was found.\n";
  for (const gap::EffectFinding& effect : diagnosis.effects) {
    const auto known = sim::make_effect(effect.name);
    const auto* const of_layout = sim::find_layout_effect(effect.name);
    // An effect on a part of a layout is never one on the whole vehicle, whatever its name.
    if (of_layout != nullptr && (!known || !effect.of.empty())) {
      text += fmt::format("\n[[{}]]  # probability {}\n", effect.name, probability_text(effect.probability));
      if (!effect.of.empty()) text += fmt::format("of = \"{}\"\n", effect.of);
      append_parameters(text, effect, of_layout->parameters);
      continue;
    }
    if (!known || !effect.of.empty()) {
      text += fmt::format("\n# {}: the simulator has no such effect.\n", printable(effect.words()));
      continue;
    }
    text += fmt::format("\n[{}]  # probability {}\n", effect.name, probability_text(effect.probability));
    append_parameters(text, effect, known->description().parameters);
  }
  return text;
}

}  // namespace navcal::report
