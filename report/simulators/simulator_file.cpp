// SPDX-License-Identifier: Apache-2.0
#include "report/simulators/simulator_file.h"

#include "report/simulators/holoocean_scenario.h"
#include "report/simulators/sitl_parameters.h"
#include "report/simulators/stonefish_scenario.h"

namespace navcal::report {

SimulatorFile simulator_file(Simulator simulator, const CorrectedModel& model) {
  switch (simulator) {
    case Simulator::sitl: return sitl_parameters(model);
    case Simulator::holoocean: return holoocean_scenario(model);
    case Simulator::stonefish: break;
  }
  return stonefish_scenario(model);
}

}  // namespace navcal::report
