// SPDX-License-Identifier: Apache-2.0
#include "analysis/simulate_effects.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include "analysis/failure.h"
#include "sim/effects/choice.h"
#include "sim/effects/document.h"
#include "sim/effects/effect_table.h"

namespace navcal::analysis {
namespace {

void add_by_strength(std::string_view text, sim::EffectSet& set, sim::Noise& noise) {
  const auto fail = [&](std::string_view why) {
    throw Failure(Exit::usage, fmt::format("--effect {}: {}", text, why));
  };
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  auto effect = sim::make_effect(name);
  if (!effect) fail(sim::unknown_effect(name));
  double strength = 1;
  if (equals != std::string_view::npos) {
    const std::string_view number = text.substr(equals + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), strength);
    if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(strength)) {
      fail("NAME=STRENGTH is expected, such as motor_field=1: a multiple of the typical strength");
    }
  }
  const auto& parameters = effect->description().parameters;
  const auto values = sim::drawn_parameters(effect->description(), strength, noise);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (const auto why = sim::refusal(parameters[i], values[i])) fail(*why);
  }
  effect->set_parameters(values);
  set.add(std::move(effect));
}

void add_from_file(const std::filesystem::path& file, sim::EffectSet& set) {
  std::ifstream in(file, std::ios::binary);
  const std::string toml{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw Failure(Exit::bad_input, file.string() + ": " + std::system_category().message(errno));
  std::vector<config::Problem> problems;
  sim::add_effects(toml, set, problems);
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += fmt::format("{}:{}: ", file.string(), problem.line);
    if (!problem.key.empty()) text += problem.key + ": ";
    text += problem.message;
  }
  if (!text.empty()) throw Failure(Exit::bad_input, text);
}

/// Along a given path the vehicle cannot be moved otherwise: better refused than silently without effect.
void refuse_on_path(const sim::EffectSet& set) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto& about = set[i].description();
    if (about.place != sim::EffectPlace::vehicle) continue;
    throw Failure(Exit::usage, fmt::format("{} changes the vehicle's motion, which --path determines: use "
                                           "--drive or --mission",
                                           about.name));
  }
}

}  // namespace

sim::EffectSet simulate_effects(const SimulateArguments& arguments) {
  constexpr std::uint64_t kApartFromNoise = 0x5851f42d4c957f2d;
  sim::EffectSet set(arguments.begin_ns);
  sim::Noise noise(arguments.seed ^ kApartFromNoise);
  for (const std::string& text : arguments.effects) add_by_strength(text, set, noise);
  if (!arguments.effects_file.empty()) add_from_file(arguments.effects_file, set);
  set.reseed(arguments.seed);
  if (!arguments.path.empty()) refuse_on_path(set);
  return set;
}

}  // namespace navcal::analysis
