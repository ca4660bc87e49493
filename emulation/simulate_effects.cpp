// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>

#include "base/failure.h"
#include "config/complaints.h"
#include "emulation/simulate_run.h"
#include "protocols/decimal.h"
#include "sim/effects/choice.h"
#include "sim/effects/document.h"
#include "sim/effects/effect_table.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::emulation {
namespace {

/// One --effect: NAME=STRENGTH, or NAME@OF=STRENGTH of a part of a layout.
class EffectOption {
 public:
  explicit EffectOption(std::string_view text) : text_(text) {
    const std::size_t equals = text.find('=');
    name_ = text.substr(0, equals);
    if (const std::size_t at = name_.find('@'); at != std::string_view::npos) {
      of_ = name_.substr(at + 1);
      name_ = name_.substr(0, at);
    }
    if (equals == std::string_view::npos) return;
    strength_ = protocols::real(text.substr(equals + 1)).value_or(std::nan(""));
  }

  void add(const config::Layout* layout, sim::EffectSet& set, sim::Noise& noise) const {
    const auto* about = layout != nullptr ? sim::find_layout_effect(name_) : nullptr;
    auto effect = about != nullptr ? nullptr : sim::make_effect(name_);
    if (about == nullptr && !effect) fail(sim::unknown_effect(name_, layout != nullptr));
    if (!std::isfinite(strength_))
      fail("NAME=STRENGTH is expected, such as motor_field=1: a multiple of the typical strength");
    if (about != nullptr) return set.add(layout_effect(*about, *layout, noise));
    if (layout != nullptr) {
      if (const auto why = sim::refusal_for_layout(effect->description())) fail(*why);
    }
    if (!of_.empty()) fail("@ names a part of a layout: --vehicle LAYOUT.toml");
    const auto values = sim::drawn_parameters(effect->description(), strength_, noise);
    expect_within(effect->description().parameters, values);
    effect->set_parameters(values);
    set.add(std::move(effect));
  }

 private:
  [[noreturn]] void fail(std::string_view why) const {
    throw base::Failure(base::Exit::usage, fmt::format("--effect {}: {}", text_, why));
  }
  void expect_within(std::span<const sim::EffectParameter> parameters, const std::vector<double>& values) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (const auto why = sim::refusal(parameters[i], values[i])) fail(*why);
    }
  }
  [[nodiscard]] sim::LayoutEffect layout_effect(const sim::LayoutEffectDescription& about,
                                                const config::Layout& layout, sim::Noise& noise) const {
    if (const auto why = sim::owner_refusal(layout, about, of_)) fail(*why);
    const auto parameters = sim::parameters_for(layout, about);
    const auto drawn = sim::described(about.name, about.equation, std::span(parameters), about.manoeuvre,
                                      {.vector = about.vector});
    sim::LayoutEffect effect{&about, std::string(of_), sim::drawn_parameters(drawn, strength_, noise)};
    expect_within(parameters, effect.values);
    return effect;
  }

  std::string_view text_, name_, of_;
  double strength_ = 1;
};

void add_from_file(const std::filesystem::path& file, const config::Layout* layout, sim::EffectSet& set) {
  std::vector<config::Problem> problems;
  sim::add_effects(config::content_of(file), set, problems, layout);
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += fmt::format("{}:{}: ", file.string(), problem.line);
    if (!problem.key.empty()) text += problem.key + ": ";
    text += problem.message;
  }
  if (!text.empty()) throw base::Failure(base::Exit::bad_input, text);
}

/// Along a given path the vehicle cannot be moved otherwise: better refused than silently without effect.
void refuse_on_path(const sim::EffectSet& set) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& about = set[i].description();
    if (about.place != sim::EffectPlace::vehicle) continue;
    throw base::Failure(
        base::Exit::usage,
        fmt::format("{} changes the vehicle's motion, which --path determines: use --drive or --mission",
                    about.name));
  }
  if (!set.layout_members().empty())
    throw base::Failure(base::Exit::usage,
                        fmt::format("{} changes the vehicle's motion, which --path determines: use --mission",
                                    set.layout_members().front().effect.about->name));
}

}  // namespace

sim::EffectSet simulate_effects(const SimulateArguments& arguments) {
  constexpr std::uint64_t kApartFromNoise = 0x5851f42d4c957f2d;
  sim::EffectSet set(arguments.begin_ns);
  sim::Noise noise(arguments.seed ^ kApartFromNoise);
  const config::Layout* const layout = arguments.layout ? &*arguments.layout : nullptr;
  for (const std::string& text : arguments.effects) EffectOption(text).add(layout, set, noise);
  if (!arguments.effects_file.empty()) add_from_file(arguments.effects_file, layout, set);
  set.reseed(arguments.seed);
  if (!arguments.path.empty()) refuse_on_path(set);
  return set;
}

}  // namespace navcal::emulation
