// SPDX-License-Identifier: Apache-2.0
// A trial of the diagnosis of layouts on simulated recordings whose causes it is not told:
//   layout_trial VEHICLE ARM COUNT SEED [TOGETHER [SECONDS]]
// TOGETHER: so many recordings of 90 s, or of SECONDS, are judged together, and none is held out. VEHICLE as of
// identification_case.h, ARM none, actuator, hull or the name of an effect. One line for each case, then counts.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <random>

#include "diagnosis/diagnose_layout.h"
#include "sim/layout/effects/layout_effects.h"
#include "tests/identify/identification_case.h"

namespace navcal::diagnosis {
namespace {

/// Instruments are as good as their tolerance, as those of the nominal recordings.
constexpr double kInstrumentErrors = 0.05;

std::vector<std::string> effects_of_arm(const config::Layout& layout, const std::string& arm) {
  std::vector<std::string> names;
  for (const auto& about : sim::layout_effects()) {
    const bool has_owner = about.part == sim::LayoutPart::vehicle || !sim::owners_of(layout, about).empty();
    if (!has_owner) continue;
    const bool is_hull = about.part == sim::LayoutPart::vehicle || about.part == sim::LayoutPart::freedom;
    if (arm == about.name || (arm == "hull" && is_hull) || (arm == "actuator" && !is_hull))
      names.emplace_back(about.name);
  }
  return names;
}

struct Drawn {
  std::string words;
  config::Layout layout;
};

Drawn draw_effect(const config::Layout& layout, const std::vector<std::string>& names, std::mt19937_64& random) {
  if (names.empty()) return {"none", layout};
  const auto* about = sim::find_layout_effect(names[random() % names.size()]);
  sim::LayoutEffect effect{about, {}, {}};
  const auto owners = sim::owners_of(layout, *about);
  if (!owners.empty()) effect.of = owners[random() % owners.size()];
  std::normal_distribution<double> normal;
  double norm = 0;
  const auto parameters = sim::parameters_for(layout, *about);
  for (const auto& parameter : parameters) {
    effect.values.push_back(parameter.typical * normal(random));
    norm += std::pow(effect.values.back() / parameter.typical, 2);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    effect.values[i] /= std::sqrt(norm);
    if (parameters[i].least == 0) effect.values[i] = std::abs(effect.values[i]);
  }
  return {effect.of.empty() ? std::string(about->name) : fmt::format("{} of {}", about->name, effect.of),
          sim::changed_layout(layout, effect)};
}

/// A vehicle as it is known after an identification: its numbers are ten times as well known as by a data sheet.
identify::VehicleCase identified(identify::VehicleCase of) {
  constexpr double kRest = 0.1;
  for (config::LayoutUncertainty& about : of.prior.uncertainties) {
    if (about.std) *about.std *= kRest;
    for (double& std : about.stds) std *= kRest;
  }
  return of;
}

int run(const std::string& vehicle, const std::string& arm, int count, std::uint64_t seed, int together,
        double seconds) {
  const identify::VehicleCase of = identified(identify::vehicle_case(vehicle));
  std::map<std::string, int> counts;
  for (int k = 0; k < count; ++k) {
    const std::uint64_t own = seed + 100 * static_cast<std::uint64_t>(k);
    std::mt19937_64 random(own);
    config::Layout truth = identify::draw_vehicle(of, own).layout;
    truth.uncertainties.clear();
    const Drawn drawn = draw_effect(truth, effects_of_arm(truth, arm), random);
    LayoutRecordings recordings{identify::draw_recording(of, drawn.layout, seconds, own + 1, kInstrumentErrors),
                                {identify::draw_recording(of, drawn.layout, 60, own + 3, kInstrumentErrors)},
                                {identify::draw_recording(of, truth, 60, own + 5, kInstrumentErrors),
                                 identify::draw_recording(of, truth, 60, own + 7, kInstrumentErrors),
                                 identify::draw_recording(of, truth, 60, own + 9, kInstrumentErrors)}};
    if (together > 0) recordings.holdouts.clear();
    for (std::uint64_t other = 1; other < static_cast<std::uint64_t>(together); ++other)
      recordings.others.push_back(
          identify::draw_recording(of, drawn.layout, seconds, own + 11 + 2 * other, kInstrumentErrors));
    const auto begin = std::chrono::steady_clock::now();
    const gap::Diagnosis answer =
        diagnose({.layout = of.prior, .excluded = {}}, recordings, [](std::string_view, double) {});
    std::string found = "none";
    for (const auto& effect : answer.effects) {
      const std::string words = effect.of.empty() ? effect.name : effect.name + " of " + effect.of;
      found = found == "none" ? words : found + " and " + words;
    }
    const bool is_none = drawn.words == "none";
    const char* score = answer.verdict == gap::Verdict::unknown  ? "unknown"
                        : answer.verdict == gap::Verdict::no_gap ? (is_none ? "right" : "missed")
                        : found == drawn.words                   ? "right"
                                                                 : "wrong";
    ++counts[score];
    fmt::print("{}: {} -> {} ({}) {} {:.1f} s\n", score, drawn.words, found, gap::name_of(answer.verdict),
               answer.sentence, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (const auto& candidate : answer.candidates) {
      if (answer.verdict == gap::Verdict::unknown)
        fmt::print("    {} {} {:.3f}\n", candidate.name, candidate.of, candidate.probability);
    }
    std::fflush(stdout);
  }
  for (const auto& [score, cases] : counts) fmt::print("{} {}/{}\n", score, cases, count);
  return 0;
}

}  // namespace
}  // namespace navcal::diagnosis

int main(int argc, char** argv) {
  if (argc < 5 || argc > 7) {
    fmt::print(stderr, "usage: layout_trial VEHICLE none|actuator|hull|EFFECT COUNT SEED [TOGETHER [SECONDS]]\n");
    return 2;
  }
  return navcal::diagnosis::run(argv[1], argv[2], std::atoi(argv[3]), std::strtoull(argv[4], nullptr, 10),
                                argc > 5 ? std::atoi(argv[5]) : 0, argc > 6 ? std::atof(argv[6]) : 90);
}
