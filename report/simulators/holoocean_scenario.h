// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/simulators/transfer.h"

namespace navcal::report {

/// A scenario of HoloOcean 2.3: the nominal vehicle as a TorpedoAUV with Fossen's dynamics, its sensors with their
/// noise, and the found effects. HoloOcean's torpedo is another model: only numbers that it has too are taken
/// over. The key "navcal", which HoloOcean does not read, says what the file contains and what was left out.
[[nodiscard]] SimulatorFile holoocean_scenario(const CorrectedModel& model);

}  // namespace navcal::report
