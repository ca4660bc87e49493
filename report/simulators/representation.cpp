// SPDX-License-Identifier: Apache-2.0
#include "report/simulators/representation.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text_rows.h"
#include "sim/effects/effect_table.h"

// Sources: ArduPilot, libraries/SITL (SITL.cpp, SIM_GPS.cpp, SIM_Compass.cpp, SIM_Aircraft.cpp,
// SIM_Submarine.cpp), AP_InertialSensor_SITL.cpp and AP_InertialSensor_tempcal.cpp of Sub 4.7; HoloOcean 2.3,
// "Sensor Configuration", "Fossen-Based Dynamics" and the API of its sensors; Stonefish, "Sensors", "Actuators",
// "Environment" and "Dynamic bodies" of its documentation, and the classes named there.
namespace navcal::report {

const char* representation_rows();  // representations.txt: "effect simulator fidelity: text"

namespace {

struct SimulatorNames {
  std::string_view name, title, ending;
};

constexpr std::array<SimulatorNames, kSimulators.size()> kSimulatorNames{
    {{"sitl", "ArduPilot SITL", ".sitl.parm"},
     {"holoocean", "HoloOcean", ".holoocean.json"},
     {"stonefish", "Stonefish", ".stonefish.xml"}}};

const SimulatorNames& names_of(Simulator simulator) {
  return kSimulatorNames[static_cast<std::size_t>(simulator)];
}

constexpr std::array<std::string_view, 3> kFidelities{"exact", "approximate", "none"};

}  // namespace

std::string_view name_of(Simulator simulator) { return names_of(simulator).name; }
std::string_view title_of(Simulator simulator) { return names_of(simulator).title; }
std::string_view ending_of(Simulator simulator) { return names_of(simulator).ending; }

std::optional<Simulator> simulator_named(std::string_view name) {
  const auto found =
      std::ranges::find_if(kSimulators, [&](Simulator simulator) { return name_of(simulator) == name; });
  if (found == kSimulators.end()) return std::nullopt;
  return *found;
}

Representation representation_of(std::string_view effect, Simulator simulator) {
  const std::string key = fmt::format("{} {} ", effect, name_of(simulator));
  for (const auto& [cell, text] : base::text_rows(representation_rows(), ": ")) {
    if (!cell.starts_with(key)) continue;
    const auto word = std::ranges::find(kFidelities, cell.substr(key.size()));
    return {static_cast<Fidelity>(word - kFidelities.begin()), text};
  }
  const auto known = sim::make_effect(effect);
  if (known && known->description().place == sim::EffectPlace::lines)
    return {Fidelity::none, "noise, clocks and lines are no cause of a gap, and no diagnosis names them"};
  return {Fidelity::none, "this version of navcal has no conversion for it"};
}

}  // namespace navcal::report
