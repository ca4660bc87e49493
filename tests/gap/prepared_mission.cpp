// SPDX-License-Identifier: Apache-2.0
#include "tests/gap/prepared_mission.h"

#include <algorithm>
#include <stdexcept>

#include "gap/inference/biases.h"
#include "sim/effects/effect_table.h"
#include "tests/gap/simulated_mission.h"

namespace navcal::gap::test {

std::unique_ptr<Prepared> prepared_mission(const SimulatedMission& simulated, const Library& library,
                                           const BankOptions& bank) {
  const config::VehicleSettings vehicle;
  auto prepared = std::make_unique<Prepared>();
  prepared->mission = simulated_mission(simulated.mission, simulated.effects, simulated.seconds, simulated.seed);
  prepared->replay = std::make_unique<Replay>(prepared->mission, vehicle);
  prepared->at = with_biases_found(*prepared->replay, library, 1);
  (void)prepared->replay->run(library.model(prepared->at), &prepared->course);
  prepared->bank =
      make_null_bank({*prepared->replay, prepared->course, vehicle}, library, prepared->at, bank, [](double) {});
  return prepared;
}

Library library_of(const std::vector<std::string>& effects) {
  std::vector<std::string> excluded;
  for (const sim::EffectEntry& entry : sim::effect_table()) {
    if (std::find(effects.begin(), effects.end(), entry.name) == effects.end()) excluded.emplace_back(entry.name);
  }
  return Library(excluded);
}

std::size_t index_of(const Library& library, std::string_view effect) {
  for (std::size_t e = 0; e < library.size(); ++e) {
    if (library[e].name == effect) return e;
  }
  throw std::invalid_argument("the library has no such effect");
}

}  // namespace navcal::gap::test
