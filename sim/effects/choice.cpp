// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "config/complaints.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::sim {
namespace {

/// "2, as a vector", "0.03 each", "0.5; 2".
std::string typical_text(const EffectDescription& effect) {
  const auto& parameters = effect.parameters;
  if (effect.vector > 1) return fmt::format("{:g}, as a vector", parameters.front().typical);
  bool same = true;
  std::string all;
  for (const EffectParameter& parameter : parameters) {
    same = same && parameter.typical == parameters.front().typical;
    all += fmt::format("{}{:g}", all.empty() ? "" : "; ", parameter.typical);
  }
  if (!same || parameters.size() == 1) return all;
  return fmt::format("{:g} each", parameters.front().typical);
}

}  // namespace

std::vector<double> drawn_parameters(const EffectDescription& effect, double strength, Noise& noise) {
  std::vector<double> values;
  for (std::size_t first = 0; first < effect.parameters.size(); first += effect.vector) {
    std::vector<double> direction;
    double square = 0;
    for (std::size_t i = 0; i < effect.vector; ++i) {
      direction.push_back(noise.normal(1));
      square += direction.back() * direction.back();
    }
    for (std::size_t i = 0; i < effect.vector; ++i) {
      const EffectParameter& parameter = effect.parameters[first + i];
      double share = direction[i] / std::sqrt(square);
      if (parameter.typical > -parameter.least) share = std::abs(share);
      values.push_back(strength * share * parameter.typical);
    }
  }
  return values;
}

std::optional<std::string> refusal(const EffectParameter& parameter, double value) {
  if (value >= parameter.least && value <= parameter.greatest) return std::nullopt;
  return fmt::format("{} lies between {:g} and {:g}, not at {:g}", parameter.name, parameter.least,
                     parameter.greatest, value);
}

std::optional<std::string> refusal_for_layout(const EffectDescription& effect) {
  constexpr std::array<std::string_view, 3> kByMotorCurrent{"accel_vibration", "adc_droop", "motor_field"};
  if (std::ranges::find(kByMotorCurrent, effect.name) != kByMotorCurrent.end())
    return fmt::format("{} grows with the motor's current, which a layout does not state", effect.name);
  if (effect.place != EffectPlace::vehicle || effect.name == "water_current") return std::nullopt;
  return fmt::format(
      "{} belongs to the vehicle of one propeller and three fins; a layout has the effects of --list-effects with "
      "a column \"of\"",
      effect.name);
}

std::string unknown_effect(std::string_view name, bool of_layout) {
  std::vector<std::string> known;
  for (const EffectEntry& entry : effect_table()) known.emplace_back(entry.name);
  if (of_layout) {
    for (const LayoutEffectDescription& about : layout_effects()) known.emplace_back(about.name);
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
  }
  return "there is no such effect" + config::suggestion_or_all(name, known);
}

void expect_effects(std::span<const std::string> excluded) {
  for (const std::string& name : excluded) {
    if (!make_effect(name))
      throw std::invalid_argument(fmt::format("--exclude {}: {}", name, unknown_effect(name)));
  }
}

std::string effects_text() {
  std::string text = "| effect | equation | parameters | typical |\n|---|---|---|---|\n";
  for (const EffectEntry& entry : effect_table()) {
    const auto effect = entry.make();
    const EffectDescription& about = effect->description();
    std::vector<std::string_view> names;
    for (const EffectParameter& parameter : about.parameters) names.push_back(parameter.name);
    // In a table a bar ends a cell.
    std::string equation;
    for (const char c : about.equation) equation += c == '|' ? std::string("\\|") : std::string(1, c);
    text +=
        fmt::format("| {} | {} | {} | {} |\n", about.name, equation, fmt::join(names, " "), typical_text(about));
  }
  return text;
}

}  // namespace navcal::sim
