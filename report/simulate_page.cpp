// SPDX-License-Identifier: Apache-2.0
#include "report/simulate_page.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "report/html_page.h"
#include "report/simulate_figures.h"

namespace navcal::report {
namespace {

std::string effect_interval_text(const sim::Interval& when) {
  if (!std::isfinite(when.from_s) && !std::isfinite(when.until_s)) return "throughout";
  if (!std::isfinite(when.until_s)) return fmt::format("from {:g} s", when.from_s);
  if (!std::isfinite(when.from_s)) return fmt::format("until {:g} s", when.until_s);
  return fmt::format("{:g} to {:g} s", when.from_s, when.until_s);
}

/// Instruments with a figure; one sentence names the others.
void append_figures(HtmlPage& page, std::vector<Figure> figures) {
  std::string missing;
  for (const Figure& figure : figures) {
    if (figure.html.empty()) missing += (missing.empty() ? "" : ", ") + figure.title;
  }
  std::erase_if(figures, [](const Figure& figure) { return figure.html.empty(); });
  if (!figures.empty()) page.figures(figures);
  if (!missing.empty()) page.paragraph("No readings in the recording: " + missing + ".");
}

void append_effects(HtmlPage& page, const sim::EffectSet& effects) {
  page.section("Effects");
  if (effects.size() == 0 && effects.layout_members().empty()) return page.paragraph("None: the nominal model.");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto& about = effects[i].description();
    std::string name(about.name), equation(about.equation), when = effect_interval_text(effects.interval(i));
    const auto values = effects[i].parameters();
    for (std::size_t k = 0; k < values.size(); ++k) {
      rows.push_back(
          {name, std::string(about.parameters[k].name), fmt::format("{:.4g}", values[k]), equation, when});
      for (auto* once : {&name, &equation, &when}) once->clear();
    }
  }
  for (const sim::EffectSet::LayoutMember& member : effects.layout_members()) {
    const sim::LayoutEffectDescription& about = *member.effect.about;
    std::string name = std::string(about.name) + (member.effect.of.empty() ? "" : " of " + member.effect.of);
    std::string equation(about.equation), when = effect_interval_text(member.when);
    for (std::size_t k = 0; k < member.effect.values.size(); ++k) {
      rows.push_back({name, std::string(about.parameters[k].name), fmt::format("{:.4g}", member.effect.values[k]),
                      equation, when});
      for (auto* once : {&name, &equation, &when}) once->clear();
    }
  }
  page.table({"Effect", "Parameter", "Value", "Equation", "When"}, rows);
}

void append_source(HtmlPage& page, const analysis::SimulateArguments& arguments,
                   const analysis::SimulatedRun& run) {
  const std::string motion = !arguments.path.empty()    ? "path " + arguments.path.string()
                             : !arguments.drive.empty() ? "drive " + arguments.drive.string()
                                                        : "mission " + arguments.mission;
  page.section("Made from");
  page.table({"", ""},
             {{"Motion", motion},
              {"Vehicle", arguments.vehicle.empty() ? "the reference vehicle" : arguments.vehicle.string()},
              {"Place", fmt::format("{:.4f}, {:.4f}", arguments.place.origin.latitude_deg,
                                    arguments.place.origin.longitude_deg)},
              {"Field of the Earth", analysis::field_text(arguments.place.field_world_uT)},
              {"Duration", fmt::format("{:g} s", run.duration_s)},
              {"Seed", std::to_string(arguments.seed)},
              {"Noise", arguments.no_noise ? "none" : "as specified"},
              {"Recording", arguments.capture.string()},
              {"Program", "navcal " NAVCAL_VERSION}});
}

}  // namespace

std::string simulate_page(const analysis::SimulateHistory& history, const analysis::SimulateArguments& arguments,
                          const analysis::SimulatedRun& run, const sim::EffectSet& effects) {
  HtmlPage page("Simulation: " + arguments.capture.filename().string());
  page.section("Motion");
  append_figures(page, motion_figures(history.series(), arguments.place.origin));
  page.section("Instruments");
  append_figures(page, instrument_figures(history.series()));
  append_effects(page, effects);
  append_source(page, arguments, run);
  return std::move(page).finish();
}

}  // namespace navcal::report
