// SPDX-License-Identifier: Apache-2.0
#include "report/simulators/simulator.h"

#include <algorithm>

namespace navcal::report {
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

}  // namespace

std::string_view name_of(Simulator simulator) { return names_of(simulator).name; }
std::string_view title_of(Simulator simulator) { return names_of(simulator).title; }
std::string_view ending_of(Simulator simulator) { return names_of(simulator).ending; }

std::optional<Simulator> simulator_named(std::string_view name) {
  const auto found = std::find_if(kSimulators.begin(), kSimulators.end(),
                                  [&](Simulator simulator) { return name_of(simulator) == name; });
  if (found == kSimulators.end()) return std::nullopt;
  return *found;
}

}  // namespace navcal::report
